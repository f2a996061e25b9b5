/* A CSV writer. SPDX-License-Identifier: MIT */
#include "csv.h"

#include "out.h"

#include <knurl/base.h>

#include <string.h>

void csv_start(csv_writer *csv, FILE *stream, const char *columns) {
    csv->stream = stream;
    csv->column = 0;
    csv_word(csv, columns);
    csv_end_row(csv);
}

static void begin_cell(csv_writer *csv) {
    if (csv->column++ > 0) {
        fputc(',', csv->stream);
    }
}

void csv_number(csv_writer *csv, double value) {
    begin_cell(csv);
    out_number(csv->stream, value);
}

void csv_word(csv_writer *csv, const char *word) {
    begin_cell(csv);
    fputs(word, csv->stream);
}

void csv_end_row(csv_writer *csv) {
    csv->column = 0;
    fputc('\n', csv->stream);
}

static int needs_apostrophe(const char *name) {
    static const char *const marks[] = {
        "'", "=", "+", "-", "@", "\xef\xbc\x9d", "\xef\xbc\x8b", "\xef\xbc\x8d", "\xef\xbc\xa0"};
    const char *first = name + strspn(name, " ");
    for (size_t i = 0; i < sizeof marks / sizeof *marks; i++) {
        if (strncmp(first, marks[i], strlen(marks[i])) == 0) {
            return 1;
        }
    }
    return strcmp(name, "none") == 0;
}

void csv_name(csv_writer *csv, const char *name) {
    char text[1024];
    (void)knurl_text_line(text, sizeof text, name); /* standard output may be a terminal */
    const int is_quoted = strpbrk(text, ",\"") != NULL;
    begin_cell(csv);
    fputs(is_quoted ? "\"" : "", csv->stream);
    fputs(needs_apostrophe(text) ? "'" : "", csv->stream);
    for (const char *c = text; *c; c++) {
        fputs(*c == '"' ? "\"" : "", csv->stream);
        fputc(*c, csv->stream);
    }
    fputs(is_quoted ? "\"" : "", csv->stream);
}

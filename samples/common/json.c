/* A JSON writer. SPDX-License-Identifier: MIT */
#include "json.h"

#include "out.h"

#include <knurl/base.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

/* The number of bytes of the character at `text`, and its code point if it must be escaped because knurl_text_line()
 * would remove it; U+FFFD for a byte that is not UTF-8. Code 0: print it unchanged. */
static int measure(const char *text, unsigned long *code) {
    const unsigned char *u = (const unsigned char *)text;
    const int length = u[0] < 0xc0 ? 1 : u[0] < 0xe0 ? 2 : u[0] < 0xf0 ? 3 : 4;
    char one[5] = {text[0]};
    char line[5];
    int bytes = 1;
    unsigned long point = length > 1 ? u[0] & (0x7fu >> length) : u[0];
    for (; bytes < length && u[bytes] >> 6 == 2; bytes++) {
        one[bytes] = text[bytes];
        point = point << 6 | (u[bytes] & 0x3fu);
    }
    const size_t written = knurl_text_line(line, sizeof line, one);
    if (strcmp(line, one) == 0) {
        *code = 0;
        return bytes;
    }
    const int is_utf8 =
        written == 1 && bytes == length && (u[0] < 0x80 || length > 1); /* otherwise a '?' for each byte */
    *code = is_utf8 ? point : 0xfffd;
    return is_utf8 ? bytes : 1;
}

/* Prints a character of a string, escaped if a terminal must not get it. Returns its number of bytes. */
static int print_character(FILE *stream, const char *c) {
    unsigned long code;
    const int bytes = measure(c, &code);
    if (code > 0xffff) {
        fprintf(stream, "\\u%04lx\\u%04lx", 0xd7c0 + (code >> 10), 0xdc00 + (code & 0x3ff));
    } else if (code) {
        fprintf(stream, "\\u%04lx", code);
    } else {
        fprintf(stream, "%.*s", bytes, c);
    }
    return bytes;
}

static void print_text(FILE *stream, const char *text) {
    fputc('"', stream);
    for (const char *c = text; *c;) {
        if (*c == '"' || *c == '\\') {
            fputc('\\', stream);
        }
        c += print_character(stream, c);
    }
    fputc('"', stream);
}

static void next_line(const json_writer *json) {
    if (json->pretty && json->depth > 0) {
        fprintf(json->stream, "\n%*s", 2 * json->depth, "");
    }
}

static void begin_value(json_writer *json, const char *key) {
    if (!json->first && json->depth > 0) {
        fputs(json->pretty ? "," : ", ", json->stream);
    }
    json->first = 0;
    next_line(json);
    if (key) {
        print_text(json->stream, key);
        fputs(": ", json->stream);
    }
}

void json_start(json_writer *json, FILE *stream, int pretty) {
    json->stream = stream;
    json->pretty = pretty;
    json->depth = 0;
    json->first = 1;
}

void json_open(json_writer *json, const char *key, char bracket) {
    begin_value(json, key);
    fputc(bracket, json->stream);
    json->depth++;
    json->first = 1;
}

void json_close(json_writer *json, char bracket) {
    json->depth--;
    if (!json->first && json->pretty) {
        fprintf(json->stream, "\n%*s", 2 * json->depth, "");
    }
    fputc(bracket, json->stream);
    if (json->depth == 0) {
        fputc('\n', json->stream);
    }
    json->first = 0;
}

static void print_number(const json_writer *json, double value) {
    if (isfinite(value)) {
        out_number(json->stream, value);
    } else {
        fputs("null", json->stream);
    }
}

void json_number(json_writer *json, const char *key, double value) {
    begin_value(json, key);
    print_number(json, value);
}

void json_numbers(json_writer *json, const char *key, const double *values, size_t count, size_t stride) {
    begin_value(json, key);
    fputc('[', json->stream);
    for (size_t i = 0; i < count; i++) {
        fputs(i > 0 ? ", " : "", json->stream);
        print_number(json, values[i * stride]);
    }
    fputc(']', json->stream);
}

void json_flag(json_writer *json, const char *key, int value) {
    begin_value(json, key);
    fputs(value ? "true" : "false", json->stream);
}

void json_string(json_writer *json, const char *key, const char *value) {
    begin_value(json, key);
    print_text(json->stream, value);
}

void json_raw(json_writer *json, const char *key, const char *value) {
    begin_value(json, key);
    for (const char *c = value; *c;) {
        if ((unsigned char)*c <= ' ') { /* between values: strings have no control characters */
            fputc(' ', json->stream);
            c++;
        } else {
            c += print_character(json->stream, c);
        }
    }
}

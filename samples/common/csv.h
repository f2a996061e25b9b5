/* A CSV writer for the tool. SPDX-License-Identifier: MIT */
#ifndef KNURL_SAMPLES_CSV_H
#define KNURL_SAMPLES_CSV_H

#include <stdio.h>

/* A CSV as it is written (RFC 4180); the commas are the writer's. */
typedef struct csv_writer {
    FILE *stream;
    int column;
} csv_writer;

/* The column's names, of the program's own, with commas between, as the first row. */
void csv_start(csv_writer *csv, FILE *stream, const char *columns);

void csv_number(csv_writer *csv, double value);   /* out_number() */
void csv_word(csv_writer *csv, const char *word); /* of the program's own: "none" */
void csv_end_row(csv_writer *csv);

/* A name of any origin, as one line (knurl_text_line()). An apostrophe is put before a name that a spreadsheet would
 * take for a formula (which begins, after any spaces, with = + - or @, narrow or full-width), before one that is a word
 * (none), and before one that begins with an apostrophe: without its first apostrophe a cell is the name again. */
void csv_name(csv_writer *csv, const char *name);

#endif

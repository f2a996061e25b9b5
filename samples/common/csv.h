/* A CSV writer for the tool. SPDX-License-Identifier: MIT */
#ifndef KNURL_SAMPLES_CSV_H
#define KNURL_SAMPLES_CSV_H

#include <stdio.h>

/* State of a CSV (RFC 4180) that is being written; the writer adds the commas. */
typedef struct csv_writer {
    FILE *stream;
    int column;
} csv_writer;

/* Writes the first row: the columns' names, constants of the program, with commas in between. */
void csv_start(csv_writer *csv, FILE *stream, const char *columns);

void csv_number(csv_writer *csv, double value);   /* out_number() */
void csv_word(csv_writer *csv, const char *word); /* a constant of the program: "none" */
void csv_end_row(csv_writer *csv);

/* An untrusted name, as one line (knurl_text_line()). It gets an apostrophe in front if a spreadsheet would take it for
 * a formula (it starts, after any spaces, with = + - or @, narrow or full-width), if it equals a word such as "none",
 * and if it starts with an apostrophe: remove a cell's first apostrophe to get the name. */
void csv_name(csv_writer *csv, const char *name);

#endif

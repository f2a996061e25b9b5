/* Output of the tool and the studies: files that are there whole or not at all, numbers that read back.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SAMPLES_OUT_H
#define KNURL_SAMPLES_OUT_H

#include <stdio.h>

/* A file that is written beside its path and renamed at the end. A device or pipe is written straight to. */
typedef struct out_file {
    FILE *stream;
    char *path;
    char *partial; /* null: written straight to */
} out_file;

/* 0, or 1 having said why in one line on stderr. */
int out_open(out_file *file, const char *path);

/* Closes and renames; 0, or 1 having said why. */
int out_keep(out_file *file);

/* Closes and removes; does nothing after out_keep(), or on a zeroed file. */
void out_discard(out_file *file);

/* The shortest decimal that reads back as the same double (15 or 17 digits); -0 is 0; "nan" for what is not finite. */
void out_number(FILE *stream, double value);

#endif

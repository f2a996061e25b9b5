/* Output of the tool and the studies. A file appears only when it is complete and never replaces an input; numbers are
 * printed so that they read back exactly.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SAMPLES_OUT_H
#define KNURL_SAMPLES_OUT_H

#include <stdio.h>

/* A file that is written under an unpredictable name in the same folder, and renamed at the end. Standard output ("-",
 * or a path to the same file), devices, pipes and FIFOs are written directly. */
typedef struct out_file {
    FILE *stream;
    char *path;
    char *partial; /* null: written directly */
    int slot;      /* of `partial` in the list of files that a signal removes; -1: the list was full */
} out_file;

/* Marks an input file: no output may replace it. It is identified by device and inode, not by name. Ignores a path that
 * does not exist, and a stream that is not a file. */
void out_protect(const char *path);
void out_protect_stream(FILE *stream);

/* 0, or 1 after printing the reason in one line on stderr. A signal that ends the process removes unfinished files
 * first. */
int out_open(out_file *file, const char *path);

/* Closes and renames; 0, or 1 after printing the reason. No later output of this process may replace it. */
int out_keep(out_file *file);

/* The same for a file that this process writes repeatedly: a crash leaves the old file or the new one, and a later
 * output may replace it. on_disk: 1: also after a power cut; takes some 20 ms. */
int out_update(out_file *file, int on_disk);

/* Closes and removes; does nothing after out_keep(), or on a zeroed file. */
void out_discard(out_file *file);

/* The shortest decimal that reads back as the same double (15 or 17 digits); -0 is 0; "nan" if it is not finite. */
void out_number(FILE *stream, double value);

#endif

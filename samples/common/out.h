/* Output of the tool and the studies. A file appears only when it is complete and never replaces an input; numbers are
 * printed so that they read back exactly.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SAMPLES_OUT_H
#define KNURL_SAMPLES_OUT_H

#include <stdio.h>

/* A file that is written beside its path, under a name that nobody can guess, and renamed at the end. Standard output
 * ("-", or a path to the same file), devices, pipes and FIFOs are written straight to. */
typedef struct out_file {
    FILE *stream;
    char *path;
    char *partial; /* null: written straight to */
    int slot;      /* of `partial` among what a signal removes; -1: none was free */
} out_file;

/* This file was read: no output may replace it. It is known by device and inode, whatever it is called. A path that
 * does not exist, and a stream that is no file, are passed over. */
void out_protect(const char *path);
void out_protect_stream(FILE *stream);

/* 0, or 1 having said why in one line on stderr. A signal that ends the process takes what is unfinished away first. */
int out_open(out_file *file, const char *path);

/* Closes and renames; 0, or 1 having said why. No later output of this process may replace it. */
int out_keep(out_file *file);

/* The same for a file that this process writes again and again: a crash leaves the old file or the new one, and a later
 * output may replace it. on_disk: 1: a power cut does so too; that takes some 20 ms. */
int out_update(out_file *file, int on_disk);

/* Closes and removes; does nothing after out_keep(), or on a zeroed file. */
void out_discard(out_file *file);

/* The shortest decimal that reads back as the same double (15 or 17 digits); -0 is 0; "nan" for what is not finite. */
void out_number(FILE *stream, double value);

#endif

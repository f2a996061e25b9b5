/* Opens input files that a user names; only regular files are read. SPDX-License-Identifier: MIT */
#ifndef KNURL_SAMPLES_IN_H
#define KNURL_SAMPLES_IN_H

#include <stdio.h>

/* Opens a regular file, or a pipe that somebody writes to, for reading; a FIFO that nobody writes to is an empty one.
 * Null: *why says what it is instead: devices have no end, and folders no lines. */
FILE *in_open(const char *path, const char **why);

/* A line of at most 64 KiB as getline() gives it; -1 at the end, and where a line is longer, with *too_long 1. */
long in_line(FILE *stream, char **line, size_t *room, int *too_long);

#endif

/* Lines of input files. SPDX-License-Identifier: MIT */
#ifndef KNURL_SAMPLES_IN_H
#define KNURL_SAMPLES_IN_H

#include <stdio.h>

/* A line of at most 64 KiB as getline() gives it; -1 at the end, and where a line is longer, with *too_long 1. */
long in_line(FILE *stream, char **line, size_t *room, int *too_long);

#endif

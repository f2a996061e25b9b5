/* Lines of input files. SPDX-License-Identifier: MIT */
#ifndef KNURL_SAMPLES_IN_H
#define KNURL_SAMPLES_IN_H

#include <stdio.h>

/* Reads a line of at most 64 KiB like getline(). -1 at the end, or, with *too_long 1, if a line is longer. */
long in_line(FILE *stream, char **line, size_t *room, int *too_long);

#endif

/* Lines of input files. SPDX-License-Identifier: MIT */
#include "in.h"

#include <stdlib.h>

#define LINE_MAX_BYTES 65536

static int grow(char **line, size_t *room) {
    const size_t wanted = *room ? 2 * *room : 256;
    char *more = realloc(*line, wanted);
    if (more) {
        *line = more;
        *room = wanted;
    }
    return more != NULL;
}

long in_line(FILE *stream, char **line, size_t *room, int *too_long) {
    long length = 0;
    int c = 0;
    *too_long = 0;
    while (c != '\n') {
        if ((size_t)length + 1 >= *room && (length > LINE_MAX_BYTES || !grow(line, room))) {
            *too_long = 1;
            return -1;
        }
        c = getc(stream);
        if (c == EOF) {
            break;
        }
        (*line)[length++] = (char)c;
    }
    (*line)[length] = '\0';
    return length > 0 ? length : -1;
}

/* Input files. SPDX-License-Identifier: MIT */
#include "in.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define LINE_MAX_BYTES 65536

FILE *in_open(const char *path, const char **why) {
    struct stat found;
    const int handle = open(path, O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC); /* does not wait for a writer */
    const int is_open = handle >= 0 && fstat(handle, &found) == 0;
    const int is_good = is_open && (S_ISREG(found.st_mode) || S_ISFIFO(found.st_mode));
    if (is_good && fcntl(handle, F_SETFL, 0) == 0) { /* reading waits for what a writer still has to say */
        FILE *stream = fdopen(handle, "r");
        if (stream) {
            return stream;
        }
    }
    *why = !is_open || is_good      ? strerror(errno)
           : S_ISDIR(found.st_mode) ? "expected a file, found a directory"
                                    : "expected a file, found a device";
    if (handle >= 0) {
        (void)close(handle);
    }
    return NULL;
}

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

/* Files that are whole or not there, numbers that read back. SPDX-License-Identifier: MIT */
#include "out.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static int fail(const char *path, const char *why) {
    fprintf(stderr, "knurl: %s: %s\n", path, why);
    return 1;
}

int out_open(out_file *file, const char *path) {
    struct stat existing;
    const int straight = stat(path, &existing) == 0 && !S_ISREG(existing.st_mode);
    const size_t length = strlen(path);
    memset(file, 0, sizeof *file);
    file->path = malloc(length + 1);
    file->partial = straight ? NULL : malloc(length + sizeof ".part");
    if (!file->path || (!straight && !file->partial)) {
        out_discard(file);
        return fail(path, "no memory");
    }
    memcpy(file->path, path, length + 1);
    if (!straight) {
        memcpy(file->partial, path, length);
        memcpy(file->partial + length, ".part", sizeof ".part");
    }
    file->stream = fopen(straight ? path : file->partial, "w");
    if (!file->stream) {
        const int code = fail(path, strerror(errno));
        free(file->partial);
        file->partial = NULL; /* there is nothing to remove */
        out_discard(file);
        return code;
    }
    return 0;
}

int out_keep(out_file *file) {
    int failed = ferror(file->stream);
    failed = fclose(file->stream) != 0 || failed;
    file->stream = NULL;
    failed = failed || (file->partial && rename(file->partial, file->path) != 0);
    if (failed) {
        (void)fail(file->path, strerror(errno));
    } else {
        free(file->partial);
        file->partial = NULL;
    }
    out_discard(file);
    return failed ? 1 : 0;
}

void out_discard(out_file *file) {
    if (file->stream) {
        (void)fclose(file->stream);
    }
    if (file->partial) {
        (void)remove(file->partial);
    }
    free(file->partial);
    free(file->path);
    memset(file, 0, sizeof *file);
}

void out_number(FILE *stream, double value) {
    char text[32];
    if (!isfinite(value)) {
        fputs("nan", stream);
        return;
    }
    (void)snprintf(text, sizeof text, "%.15g", value + 0.0);
    if (strtod(text, NULL) != value) {
        (void)snprintf(text, sizeof text, "%.17g", value + 0.0);
    }
    fputs(text, stream);
}

/* Output files, written completely or not at all. SPDX-License-Identifier: MIT */
#include "out.h"

#include "options.h"
#include "os.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>

#define TEMPORARY_ROOM 4096 /* PATH_MAX on Linux */
#define NAME_KEPT      200  /* bytes of the file's name kept in the temporary name: names are limited to 255 */

static os_file *inputs; /* for as long as the process lives */
static size_t input_count;
static int inputs_missing; /* 1: there was no memory for all of them, so that no check is possible */

/* Files that a signal removes; a study writes at most three at a time. A slot is filled before `used` is set. */
static struct {
    char path[TEMPORARY_ROOM];
    volatile sig_atomic_t used;
} unfinished[8];

static int fail(const char *path, const char *why) {
    return tool_error(1, "%s: %s", path, why);
}

static void protect(const os_file *found) {
    os_file *more = realloc(inputs, (input_count + 1) * sizeof *more);
    if (!more) {
        inputs_missing = 1;
        return;
    }
    inputs = more;
    inputs[input_count++] = *found;
}

void out_protect(const char *path) {
    os_file found;
    if (path && os_identify(path, &found) == 0 && found.is_regular) {
        protect(&found);
    }
}

void out_protect_stream(FILE *stream) {
    os_file found;
    if (os_identify_stream(stream, &found) == 0 && found.is_regular) {
        protect(&found);
    }
}

static int is_same(const os_file *a, const os_file *b) {
    return a->device == b->device && a->number == b->number && (a->device || a->number);
}

static int is_input(const os_file *found) {
    for (size_t i = 0; i < input_count; i++) {
        if (is_same(&inputs[i], found)) {
            return 1;
        }
    }
    return inputs_missing;
}

static int is_stdout(const char *path, const os_file *found) {
    os_file standard;
    return strcmp(path, "-") == 0 || (os_identify_stream(stdout, &standard) == 0 && is_same(&standard, found));
}

/* 1 for paths that must not be replaced by a rename: the link /dev/stdout may lead to a regular file, or nowhere.
 * found: null if there is no such file. */
static int is_special(const char *path, const os_file *found) {
    return strncmp(path, "/dev/", 5) == 0 || strncmp(path, "/proc/", 6) == 0 ||
           (found && (!found->is_regular || is_stdout(path, found)));
}

static void remove_unfinished(void) {
    for (size_t i = 0; i < sizeof unfinished / sizeof *unfinished; i++) {
        if (unfinished[i].used) {
            (void)os_remove(unfinished[i].path);
        }
    }
}

/* Finds a free slot for a name. */
static int enlist(const char *path) {
    for (int i = 0; i < (int)(sizeof unfinished / sizeof *unfinished); i++) {
        if (!unfinished[i].used) {
            memcpy(unfinished[i].path, path, strlen(path) + 1);
            unfinished[i].used = 1;
            return i;
        }
    }
    return -1;
}

static void strike(out_file *file) {
    if (file->slot >= 0) {
        unfinished[file->slot].used = 0;
    }
    file->slot = -1;
    free(file->partial);
    file->partial = NULL;
}

/* In the same folder, so that it can be renamed: PATH.RANDOM.part, which must not exist yet. */
static FILE *create_temporary(out_file *file) {
    char name[TEMPORARY_ROOM];
    const char *base = os_base_name(file->path);
    const size_t length = strlen(base) < NAME_KEPT ? strlen(base) : NAME_KEPT;
    for (int tries = 0; tries < 100; tries++) {
        uint64_t random = 0;
        if (os_random(&random)) {
            return NULL;
        }
        const int written = snprintf(name, sizeof name, "%.*s%.*s.%016" PRIx64 ".part", (int)(base - file->path),
                                     file->path, (int)length, base, random);
        if (written < 0 || (size_t)written >= sizeof name) {
            errno = ENAMETOOLONG;
            return NULL;
        }
        const int slot = enlist(name);
        FILE *stream = os_create(name);
        if (stream) {
            file->slot = slot;
            file->partial = strdup(name);
            if (file->partial) {
                return stream;
            }
            (void)fclose(stream);
            (void)os_remove(name);
            strike(file);
            return NULL;
        }
        if (slot >= 0) {
            unfinished[slot].used = 0;
        }
        if (errno != EEXIST) {
            return NULL;
        }
    }
    return NULL;
}

static void open_stream(out_file *file) {
    os_file found;
    const int exists =
        strcmp(file->path, "-") == 0 ? os_identify_stream(stdout, &found) == 0 : os_identify(file->path, &found) == 0;
    if (is_special(file->path, exists ? &found : NULL)) {
        file->stream = exists && is_stdout(file->path, &found) ? os_open_stdout() : os_open_output(file->path);
        return;
    }
    os_before_end(remove_unfinished);
    file->stream = create_temporary(file);
}

static int refuse_input(const char *path) {
    os_file found;
    return os_identify(path, &found) == 0 && is_input(&found)
               ? fail(path, "expected an output of its own, found a file that is read, or another output: it would be "
                            "replaced")
               : 0;
}

int out_open(out_file *file, const char *path) {
    memset(file, 0, sizeof *file);
    file->slot = -1;
    if (!*path) {
        return fail("''", "expected the name of a file to write, found none");
    }
    if (refuse_input(path)) {
        return 1;
    }
    file->path = strdup(path);
    if (!file->path) {
        return fail(path, "no memory");
    }
    open_stream(file);
    if (!file->stream) {
        const int code = fail(path, strerror(errno));
        out_discard(file);
        return code;
    }
    return 0;
}

static int finish(out_file *file, int may_be_replaced) {
    int failed = ferror(file->stream);
    failed = fclose(file->stream) != 0 || failed;
    file->stream = NULL;
    if (!failed && file->partial &&
        refuse_input(file->path)) { /* check again: links may have changed since it was opened */
        out_discard(file);
        return 1;
    }
    failed = failed || (file->partial && os_replace(file->path, file->partial) != 0);
    if (failed) {
        (void)fail(file->path, strerror(errno));
    } else {
        if (file->partial && !may_be_replaced) {
            out_protect(file->path); /* from later outputs */
        }
        strike(file);
    }
    out_discard(file);
    return failed ? 1 : 0;
}

int out_keep(out_file *file) {
    return finish(file, 0);
}

int out_update(out_file *file, int on_disk) {
    if (on_disk && os_sync(file->stream) != 0) {
        const int code = fail(file->path, strerror(errno));
        out_discard(file);
        return code;
    }
    return finish(file, 1);
}

void out_discard(out_file *file) {
    if (file->stream) {
        (void)fclose(file->stream);
    }
    if (file->partial) {
        (void)os_remove(file->partial);
        strike(file);
    }
    free(file->path);
    memset(file, 0, sizeof *file);
    file->slot = -1;
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

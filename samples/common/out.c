/* Output files, written completely or not at all. SPDX-License-Identifier: MIT */
#include "out.h"

#include "options.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#define TEMPORARY_ROOM 4096 /* PATH_MAX on Linux */
#define NAME_KEPT      200  /* bytes of the file's own name in the temporary one: names end at 255 */

/* Which file, whatever it is called. */
typedef struct identity {
    dev_t device;
    ino_t number;
} identity;

static identity *inputs; /* for as long as the process lives */
static size_t input_count;
static int inputs_missing; /* 1: there was no memory for all of them, so that none is told apart */

/* What a signal removes: a study writes three files at a time at most. A slot is filled before `used` says so. */
static struct {
    char path[TEMPORARY_ROOM];
    volatile sig_atomic_t used;
} unfinished[8];

static int fail(const char *path, const char *why) {
    return tool_error(1, "%s: %s", path, why);
}

static void protect(const struct stat *found) {
    identity *more = realloc(inputs, (input_count + 1) * sizeof *more);
    if (!more) {
        inputs_missing = 1;
        return;
    }
    inputs = more;
    inputs[input_count].device = found->st_dev;
    inputs[input_count++].number = found->st_ino;
}

void out_protect(const char *path) {
    struct stat found;
    if (path && stat(path, &found) == 0 && S_ISREG(found.st_mode)) {
        protect(&found);
    }
}

void out_protect_stream(FILE *stream) {
    struct stat found;
    if (fstat(fileno(stream), &found) == 0 && S_ISREG(found.st_mode)) {
        protect(&found);
    }
}

static int is_input(const struct stat *found) {
    for (size_t i = 0; i < input_count; i++) {
        if (inputs[i].device == found->st_dev && inputs[i].number == found->st_ino) {
            return 1;
        }
    }
    return inputs_missing;
}

/* 1 for what is not a file by its own name: /dev/stdout may lead to a regular file, and is not to be renamed over. */
static int is_special(const char *path, const struct stat *found) {
    struct stat standard;
    return !S_ISREG(found->st_mode) || strncmp(path, "/dev/", 5) == 0 || strncmp(path, "/proc/", 6) == 0 ||
           (fstat(STDOUT_FILENO, &standard) == 0 && standard.st_dev == found->st_dev &&
            standard.st_ino == found->st_ino);
}

static FILE *open_special(const char *path, const struct stat *found) {
    struct stat standard;
    if (fstat(STDOUT_FILENO, &standard) == 0 && standard.st_dev == found->st_dev && standard.st_ino == found->st_ino) {
        (void)fflush(stdout);
        const int copy = dup(STDOUT_FILENO); /* one offset for both */
        return copy >= 0 ? fdopen(copy, "w") : NULL;
    }
    return fopen(path, "w");
}

static void on_signal(int number) {
    for (size_t i = 0; i < sizeof unfinished / sizeof *unfinished; i++) {
        if (unfinished[i].used) {
            (void)unlink(unfinished[i].path);
        }
    }
    (void)signal(number, SIG_DFL);
    (void)raise(number);
}

/* Only where a signal would simply end the process: who handles it, or ignores it, goes on doing so. */
static void clean_up_on_signals(void) {
    static const int numbers[] = {SIGINT, SIGTERM, SIGHUP};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
        struct sigaction action;
        if (sigaction(numbers[i], NULL, &action) == 0 && !(action.sa_flags & SA_SIGINFO) &&
            action.sa_handler == SIG_DFL) {
            memset(&action, 0, sizeof action);
            action.sa_handler = on_signal;
            (void)sigaction(numbers[i], &action, NULL);
        }
    }
}

/* A slot for a name that is not taken yet. */
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

/* In the same folder, so that it can be renamed: PATH.RANDOM.part, created here or not at all. */
static int create_temporary(out_file *file) {
    char name[TEMPORARY_ROOM];
    const char *slash = strrchr(file->path, '/');
    const char *base = slash ? slash + 1 : file->path;
    const size_t length = strlen(base) < NAME_KEPT ? strlen(base) : NAME_KEPT;
    for (int tries = 0; tries < 100; tries++) {
        uint64_t random = 0;
        if (getrandom(&random, sizeof random, 0) != (ssize_t)sizeof random) {
            return -1;
        }
        const int written = snprintf(name, sizeof name, "%.*s%.*s.%016" PRIx64 ".part", (int)(base - file->path),
                                     file->path, (int)length, base, random);
        if (written < 0 || (size_t)written >= sizeof name) {
            errno = ENAMETOOLONG;
            return -1;
        }
        const int slot = enlist(name);
        const int handle = open(name, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
        if (handle >= 0) {
            file->slot = slot;
            file->partial = strdup(name);
            return handle;
        }
        if (slot >= 0) {
            unfinished[slot].used = 0;
        }
        if (errno != EEXIST) {
            return -1;
        }
    }
    return -1;
}

static void open_stream(out_file *file) {
    struct stat found;
    const int exists = strcmp(file->path, "-") == 0 ? fstat(STDOUT_FILENO, &found) == 0 : stat(file->path, &found) == 0;
    if (exists && is_special(file->path, &found)) {
        file->stream = open_special(file->path, &found);
        return;
    }
    clean_up_on_signals();
    const int handle = create_temporary(file);
    if (handle >= 0) {
        file->stream = file->partial ? fdopen(handle, "w") : NULL;
        if (!file->stream) {
            (void)close(handle);
        }
    }
}

static int refuse_input(const char *path) {
    struct stat found;
    return stat(path, &found) == 0 && is_input(&found)
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

int out_keep(out_file *file) {
    int failed = ferror(file->stream);
    failed = fclose(file->stream) != 0 || failed;
    file->stream = NULL;
    if (!failed && file->partial && refuse_input(file->path)) { /* again: links may have changed since it was opened */
        out_discard(file);
        return 1;
    }
    failed = failed || (file->partial && rename(file->partial, file->path) != 0);
    if (failed) {
        (void)fail(file->path, strerror(errno));
    } else {
        if (file->partial) {
            out_protect(file->path); /* against the next output */
        }
        strike(file);
    }
    out_discard(file);
    return failed ? 1 : 0;
}

void out_leave(out_file *file) {
    if (file->partial) {
        strike(file);
    }
    out_discard(file);
}

void out_discard(out_file *file) {
    if (file->stream) {
        (void)fclose(file->stream);
    }
    if (file->partial) {
        (void)remove(file->partial);
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

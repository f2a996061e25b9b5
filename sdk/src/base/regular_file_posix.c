/* Regular files on POSIX systems. SPDX-License-Identifier: MIT */
#include "base/regular_file.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* O_NONBLOCK: opening a FIFO does not wait for a writer, and opening a device does not wait either. */
#define FLAGS (O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC)

static FILE *refuse(const char *reason, char *why, size_t why_size) {
    (void)snprintf(why, why_size, "%s", reason);
    return NULL;
}

static FILE *refuse_errno(char *why, size_t why_size) {
    const int number = errno;
    return number == ENOENT  ? refuse("no such file", why, why_size)
           : number == ELOOP ? refuse("expected a file, found a symbolic link", why, why_size)
                             : refuse(strerror(number), why, why_size);
}

/* Opens `path` part by part without following links. Returns -1 and errno if a part is a link or missing. */
static int open_below(const char *folder, const char *path) {
    int at = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    while (at >= 0 && *path) {
        char part[256];
        const size_t length = strcspn(path, "/");
        const int is_last = path[length] == '\0';
        int next = -1;
        errno = ENAMETOOLONG;
        if (length < sizeof part) {
            memcpy(part, path, length);
            part[length] = '\0';
            next = openat(at, part, O_NOFOLLOW | (is_last ? FLAGS : O_RDONLY | O_DIRECTORY | O_CLOEXEC));
        }
        const int number = errno;
        (void)close(at);
        errno = number;
        at = next;
        path += length + !is_last;
    }
    return at;
}

FILE *knurl_regular_open(const char *folder, const char *path, uint64_t *size, char *why, size_t why_size) {
    struct stat found;
    const int handle = folder ? open_below(folder, path) : open(path, FLAGS);
    if (handle < 0 || fstat(handle, &found) != 0) {
        FILE *none = refuse_errno(why, why_size);
        if (handle >= 0) {
            (void)close(handle);
        }
        return none;
    }
    if (!S_ISREG(found.st_mode)) {
        (void)close(handle);
        return refuse(S_ISDIR(found.st_mode) ? "expected a regular file, found a directory"
                                             : "expected a regular file, found a special file",
                      why, why_size);
    }
    FILE *file = fdopen(handle, "rb");
    if (!file) {
        (void)refuse_errno(why, why_size);
        (void)close(handle);
        return NULL;
    }
    *size = (uint64_t)found.st_size;
    return file;
}

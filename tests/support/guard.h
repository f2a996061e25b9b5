/* Looking for the guard process of a device. SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_GUARD_H
#define KNURL_TEST_GUARD_H

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

/** The process, not this one, whose descriptor 1 is that file; 0: not found. */
static inline pid_t find_guard(ino_t file) {
    DIR *all = opendir("/proc");
    pid_t found = 0;
    for (const struct dirent *one = all ? readdir(all) : NULL; one; one = readdir(all)) {
        char path[64];
        struct stat about;
        const int pid = (int)strtol(one->d_name, NULL, 10);
        (void)snprintf(path, sizeof path, "/proc/%d/fd/1", pid);
        if (pid > 0 && pid != getpid() && stat(path, &about) == 0 && about.st_ino == file) {
            found = pid;
        }
    }
    if (all) {
        (void)closedir(all);
    }
    return found;
}

#endif

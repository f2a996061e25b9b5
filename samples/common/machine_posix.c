/* The machine's name, and programs in the folder of this one. SPDX-License-Identifier: MIT */
#include "machine.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

void machine_name(char *name, size_t size) {
    char line[256];
    FILE *stream = fopen("/proc/cpuinfo", "r");
    (void)snprintf(name, size, "unknown");
    while (stream && fgets(line, sizeof line, stream)) {
        const char *colon = strchr(line, ':');
        if (strncmp(line, "model name", 10) == 0 && colon) {
            (void)snprintf(name, size, "%.*s, %ld cores", (int)strcspn(colon, "\n") - 2, colon + 2,
                           sysconf(_SC_NPROCESSORS_ONLN));
            break;
        }
    }
    if (stream) {
        (void)fclose(stream);
    }
    for (char *c = name; *c; c++) {
        *c = *c == '"' || *c == '\\' || (unsigned char)*c < 0x20 ? ' ' : *c;
    }
}

int machine_program(const char *name, char *path, size_t size) {
    char self[4096]; /* PATH_MAX on Linux */
    const ssize_t length = readlink("/proc/self/exe", self, sizeof self - 1);
    self[length > 0 ? length : 0] = 0;
    const char *slash = strrchr(self, '/');
    const int written = slash ? snprintf(path, size, "%.*s%s", (int)(slash + 1 - self), self, name) : -1;
    if (written < 0 || (size_t)written >= size) {
        path[0] = 0;
        return 1;
    }
    return access(path, X_OK) != 0;
}

/* Files read whole. SPDX-License-Identifier: MIT */
#include "whole_file.h"

#include "os.h"
#include "tool.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#define BYTES_MAX ((size_t)1 << 30) /* as the library's limit of a glTF file */

int whole_file_read(const char *path, whole_file *file) {
    const char *why = NULL;
    FILE *stream = os_open_input(path, &why);
    size_t room = 0;
    size_t got = 1;
    if (!stream) {
        return tool_error(TOOL_FAILURE, "%s: cannot be read: %s", path, why ? why : strerror(errno));
    }
    while (got > 0) {
        if (file->size == room) {
            room = room ? 2 * room : (size_t)1 << 16;
            unsigned char *more = room > BYTES_MAX ? NULL : realloc(file->data, room);
            if (!more) {
                (void)fclose(stream);
                return tool_error(TOOL_FAILURE, "%s: expected a file of at most 1 GiB that fits into memory", path);
            }
            file->data = more;
        }
        got = fread(file->data + file->size, 1, room - file->size, stream);
        file->size += got;
    }
    const int failed = ferror(stream);
    (void)fclose(stream);
    return failed ? tool_error(TOOL_FAILURE, "%s: cannot be read", path) : TOOL_OK;
}

void whole_file_replace(void *user, const void *data, uint64_t size) {
    whole_file *file = user;
    unsigned char *copy = malloc((size_t)size);
    free(file->data);
    file->data = copy;
    file->size = copy ? (size_t)size : 0;
    if (copy) {
        memcpy(copy, data, file->size);
    }
}

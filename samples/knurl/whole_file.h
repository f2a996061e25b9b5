/* Files read whole. SPDX-License-Identifier: MIT */
#ifndef KNURL_WHOLE_FILE_H
#define KNURL_WHOLE_FILE_H

#include <stddef.h>
#include <stdint.h>

typedef struct whole_file {
    unsigned char *data; /* the caller frees it, also after a failure */
    size_t size;
} whole_file;

/* A zeroed file from a path. TOOL_OK, or TOOL_FAILURE having said why. */
int whole_file_read(const char *path, whole_file *file);

/* A knurl_gltf_write_callback: replaces the contents of `user`, a whole_file; data is null if there is no memory. */
void whole_file_replace(void *user, const void *data, uint64_t size);

#endif

/* Opens files by untrusted names: a file is opened first and checked afterwards, so that it cannot be replaced in
 * between. Only regular files are read; a FIFO is refused without waiting. Compiled into both libraries.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_REGULAR_FILE_H
#define KNURL_SRC_REGULAR_FILE_H

#include "base/finite.h"

#include <stdint.h>
#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Opens for reading in binary. folder: null, and links are followed; else `path` is relative to it, with / between its
 * parts, and none of these may be a link. size: bytes, as the file was when it was opened. Null: `why` says why, in a
 * few words. */
FILE *knurl_regular_open(const char *folder, const char *path, uint64_t *size, char *why, size_t why_size);

#ifdef __cplusplus
}
#endif
#endif

/* Opens files by untrusted names: opens first and checks the open file, which cannot be replaced in between. Only
 * regular files; a FIFO is refused without waiting. Compiled into both libraries.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_REGULAR_FILE_H
#define KNURL_SRC_REGULAR_FILE_H

#include "base/finite.h"

#include <stdint.h>
#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Opens for reading in binary. folder: if null, links are followed; else `path` is relative to it, with / between its
 * parts, and no part may be a link. size: the file's bytes when opened. Returns null and a short reason in `why` if it
 * fails. */
FILE *knurl_regular_open(const char *folder, const char *path, uint64_t *size, char *why, size_t why_size);

#ifdef __cplusplus
}
#endif
#endif

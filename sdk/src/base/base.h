/* What rooms share and no caller sees: growable structs, thread-local storage, 3-vectors' home is base/vec3.h.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_BASE_H
#define KNURL_SRC_BASE_H

#include "base/finite.h"

#include <knurl/base.h>

#if defined(_MSC_VER)
#define KNURL_THREAD_LOCAL __declspec(thread)
#else
#define KNURL_THREAD_LOCAL __thread /* C99 has none; every other compiler that builds this has this one */
#endif

/* Writes a filled-in local struct (its first field a uint32_t struct_size) into a caller's of `size` bytes, which may
 * be older and shorter, or newer and longer: what this version does not know becomes 0. */
void knurl_desc_write(const void *local, uint32_t local_size, void *caller, uint32_t size);

/* The same for a struct that is an output and whose caller has set struct_size. Errors: KNURL_ERROR_ARGUMENT. */
knurl_result knurl_desc_return(const char *type, const void *local, uint32_t local_size, void *caller);

/* Reads a caller's struct over a local one that holds the defaults. An older caller's missing fields keep them; a newer
 * caller's extra fields must be 0. Errors: KNURL_ERROR_ARGUMENT, KNURL_ERROR_UNSUPPORTED. */
knurl_result knurl_desc_read(const char *type, const void *caller, void *local, uint32_t local_size);

#endif

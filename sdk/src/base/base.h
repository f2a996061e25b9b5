/* Helpers for all modules, with those of error.h: null checks, marks for branches. Vectors are in vec3.h.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_BASE_H
#define KNURL_SRC_BASE_H

#include "base/error.h"
#include "base/finite.h"
#include "base/handle.h"

#include <knurl/base.h>

/* The usual outcome of a branch in a tick: the compiler lays out that path without jumps. */
#if defined(__GNUC__)
#define KNURL_LIKELY(condition)   (__builtin_expect(!!(condition), 1) != 0)
#define KNURL_UNLIKELY(condition) (__builtin_expect(!!(condition), 0) != 0)
#else
#define KNURL_LIKELY(condition)   (condition)
#define KNURL_UNLIKELY(condition) (condition)
#endif

/* For functions that only prefetch: unless inlined, GCC 12 removes calls to them as having no effect. */
#define KNURL_PREFETCHING static inline __attribute__((always_inline))

/* Copies a local struct (its first field is uint32_t struct_size) to a caller's of `size` bytes, which may be older and
 * shorter, or newer and longer: fields unknown to this version become 0. If `caller` is null, writes nothing and sets
 * an error message that names the parameter. */
#define knurl_desc_write(local, local_size, caller, size)                                                              \
    (KNURL_IS_NULL(caller) ? (void)0 : knurl_desc_copy((local), (local_size), (caller), (size)))

#endif

/* Helpers for all modules, with those of error.h: null checks, marks for branches. Vectors are in vec3.h.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_BASE_H
#define KNURL_SRC_BASE_H

#include "base/error.h"
#include "base/finite.h"
#include "base/handle.h"

#include <knurl/base.h>

/* Which way a branch of a tick usually goes: the compiler lays that way out without jumps. */
#if defined(__GNUC__)
#define KNURL_LIKELY(condition)   (__builtin_expect(!!(condition), 1) != 0)
#define KNURL_UNLIKELY(condition) (__builtin_expect(!!(condition), 0) != 0)
#else
#define KNURL_LIKELY(condition)   (condition)
#define KNURL_UNLIKELY(condition) (condition)
#endif

/* Begins a function that only prefetches: GCC 12 takes its call for one without effect, and leaves it out. */
#define KNURL_PREFETCHING static inline __attribute__((always_inline))

/* Writes a filled-in local struct (its first field a uint32_t struct_size) into a caller's of `size` bytes, which may
 * be older and shorter, or newer and longer: what this version does not know becomes 0. Null: nothing is written, and
 * the error message names the parameter. */
#define knurl_desc_write(local, local_size, caller, size)                                                              \
    (KNURL_IS_NULL(caller) ? (void)0 : knurl_desc_copy((local), (local_size), (caller), (size)))

#endif

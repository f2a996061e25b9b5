/* Helpers for all modules: growable structs, thread-local storage, marks for branches. Vectors are in vec3.h.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_BASE_H
#define KNURL_SRC_BASE_H

#include "base/finite.h"
#include "base/handle.h"

#include <knurl/base.h>

#if defined(_MSC_VER)
#define KNURL_THREAD_LOCAL __declspec(thread)
#else
#define KNURL_THREAD_LOCAL __thread /* C99 has none; every other compiler that builds this has this one */
#endif

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

/* For a call on the haptic path that fails: this thread's error message becomes `sentence`, which stays where it is (a
 * literal, knurl_result_string()). One store into the thread's memory: no heap, lock or formatting. Returns `code`. */
#if defined(__GNUC__)
__attribute__((cold)) /* branches to it are kept out of the way of those that go well */
#endif
knurl_result knurl_fail_static(knurl_result code, const char *sentence) KNURL_NONBLOCKING;

/* Writes a filled-in local struct (its first field a uint32_t struct_size) into a caller's of `size` bytes, which may
 * be older and shorter, or newer and longer: what this version does not know becomes 0. Null: nothing is written, and
 * the error message names the parameter. */
#define knurl_desc_write(local, local_size, caller, size)                                                              \
    (KNURL_IS_NULL(caller) ? (void)0 : knurl_desc_copy((local), (local_size), (caller), (size)))
void knurl_desc_copy(const void *local, uint32_t local_size, void *caller, uint32_t size);

/* The same for a struct that is an output and whose caller has set struct_size. Errors: KNURL_ERROR_ARGUMENT. */
knurl_result knurl_desc_return(const char *type, const void *local, uint32_t local_size, void *caller);

/* Ends a text (bytes `begin` to `end` of the struct) that an older caller's struct, returned by now, cuts off. */
void knurl_desc_end_text(void *caller, size_t begin, size_t end);

/* Reads a caller's struct over a local one that holds the defaults. An older caller's missing fields keep them; a newer
 * caller's extra fields must be 0. Errors: KNURL_ERROR_ARGUMENT, KNURL_ERROR_UNSUPPORTED. */
knurl_result knurl_desc_read(const char *type, const void *caller, void *local, uint32_t local_size);

#endif

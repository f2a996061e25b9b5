/* The thread's error message and growable structs. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_ERROR_H
#define KNURL_SRC_ERROR_H

#include <knurl/base.h>

#include <stddef.h>

#if defined(_MSC_VER)
#define KNURL_THREAD_LOCAL __declspec(thread)
#else
#define KNURL_THREAD_LOCAL __thread /* not in C99; GCC and Clang have it */
#endif

/* Sets this thread's error message on the haptic path. sentence: static, not copied (a literal or
 * knurl_result_string()). One store into the thread's memory: no heap, lock or formatting. Returns `code`. */
#if defined(__GNUC__)
__attribute__((cold)) /* keeps failure branches out of the hot path */
#endif
knurl_result knurl_fail_static(knurl_result code, const char *sentence) KNURL_NONBLOCKING;

/* See knurl_desc_write() in base.h. */
void knurl_desc_copy(const void *local, uint32_t local_size, void *caller, uint32_t size);

/* The same for an output struct whose caller has set struct_size. Errors: KNURL_ERROR_ARGUMENT. */
knurl_result knurl_desc_return(const char *type, const void *local, uint32_t local_size, void *caller);

/* After knurl_desc_return(): terminates the text in bytes `begin` to `end` if an older, shorter struct cuts it off. */
void knurl_desc_end_text(void *caller, size_t begin, size_t end);

/* Copies a caller's struct over a local one with the defaults. Fields missing in an older caller's struct keep their
 * defaults; extra fields of a newer caller's must be 0. Errors: KNURL_ERROR_ARGUMENT, KNURL_ERROR_UNSUPPORTED. */
knurl_result knurl_desc_read(const char *type, const void *caller, void *local, uint32_t local_size);

#endif

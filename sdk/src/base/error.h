/* The thread's error message and growable structs. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_ERROR_H
#define KNURL_SRC_ERROR_H

#include <knurl/base.h>

#include <stddef.h>

#if defined(_MSC_VER)
#define KNURL_THREAD_LOCAL __declspec(thread)
#else
#define KNURL_THREAD_LOCAL __thread /* C99 has none; every other compiler that builds this has this one */
#endif

/* For a call on the haptic path that fails: this thread's error message becomes `sentence`, which stays where it is (a
 * literal, knurl_result_string()). One store into the thread's memory: no heap, lock or formatting. Returns `code`. */
#if defined(__GNUC__)
__attribute__((cold)) /* branches to it are kept out of the way of those that go well */
#endif
knurl_result knurl_fail_static(knurl_result code, const char *sentence) KNURL_NONBLOCKING;

/* What knurl_desc_write() of base.h calls. */
void knurl_desc_copy(const void *local, uint32_t local_size, void *caller, uint32_t size);

/* Writes a filled-in local struct into a caller's that is an output and whose struct_size is set. What this version
 * does not know becomes 0. Errors: KNURL_ERROR_ARGUMENT. */
knurl_result knurl_desc_return(const char *type, const void *local, uint32_t local_size, void *caller);

/* Ends a text (bytes `begin` to `end` of the struct) that an older caller's struct, returned by now, cuts off. */
void knurl_desc_end_text(void *caller, size_t begin, size_t end);

/* Reads a caller's struct over a local one that holds the defaults. An older caller's missing fields keep them; a newer
 * caller's extra fields must be 0. Errors: KNURL_ERROR_ARGUMENT, KNURL_ERROR_UNSUPPORTED. */
knurl_result knurl_desc_read(const char *type, const void *caller, void *local, uint32_t local_size);

#endif

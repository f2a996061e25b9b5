/* System libraries loaded at run time, so that Knurl starts without them; if one is missing, its driver is disabled
 * with a message.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_DYNLIB_H
#define KNURL_SRC_DYNLIB_H

#include <knurl/base.h>

/* A function's name, and the address of the function pointer to set. */
typedef struct knurl_dynlib_function {
    const char *name;
    void *function;
} knurl_dynlib_function;

/* Loads the first of the named libraries that exists and sets all function pointers, or leaves all unset. Returns 1, or
 * 0 with the reason in `why`. *state: 0 at first, one per library; once loaded, further calls return 1 at once. The
 * library stays loaded until the process ends. Concurrent calls for the same library wait. [any thread] */
int knurl_dynlib_load(uint32_t *state, const char *const *names, size_t name_count,
                      const knurl_dynlib_function *functions, size_t function_count, char *why, size_t why_size);

#endif

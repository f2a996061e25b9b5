/* System libraries that a driver loads at run time, so that Knurl starts without them; a missing one disables its
 * driver with a message.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_DYNLIB_H
#define KNURL_SRC_DYNLIB_H

#include <knurl/base.h>

/* One function: its name, and where its address goes (a pointer to a function pointer). */
typedef struct knurl_dynlib_function {
    const char *name;
    void *function;
} knurl_dynlib_function;

/* Loads the first of the named libraries that is there, for the rest of the process, and finds all functions or none.
 * Returns 1, or 0 where `why` says what is missing. *state: the library's own, 0 at first. Once it is loaded nothing is
 * loaded or written again. While a thread loads it, others that ask for the same wait. [any thread] */
int knurl_dynlib_load(uint32_t *state, const char *const *names, size_t name_count,
                      const knurl_dynlib_function *functions, size_t function_count, char *why, size_t why_size);

#endif

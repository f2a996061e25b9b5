/* Loads libraries at run time. SPDX-License-Identifier: MIT */
#include "device/dynlib.h"

#include "base/system.h"

#include <stdio.h>
#include <string.h>

/* Values of *state. */
enum { ABSENT, LOADING, LOADED };

static int load(const char *const *names, size_t name_count, const knurl_dynlib_function *functions,
                size_t function_count, char *why, size_t why_size) {
    knurl_library *library = NULL;
    why[0] = '\0';
    for (size_t i = 0; i < name_count && !library; i++) {
        char reason[160];
        const size_t used = strlen(why);
        library = knurl_system_load_library(names[i], reason, sizeof reason);
        if (!library) {
            (void)snprintf(why + used, why_size - used, "%s%s (%s)", used ? "; " : "", names[i], reason);
        }
    }
    for (size_t i = 0; library && i < function_count; i++) { /* find all before setting any */
        void (*found)(void) = NULL;
        if (!knurl_system_find_function(library, functions[i].name, &found)) {
            (void)snprintf(why, why_size, "it has no %s", functions[i].name);
            knurl_system_unload_library(library);
            return 0;
        }
    }
    for (size_t i = 0; library && i < function_count; i++) {
        (void)knurl_system_find_function(library, functions[i].name, functions[i].function);
    }
    return library != NULL;
}

/* A state for each library instead of a common lock: if one vendor's start-up code hangs, others still load. */
int knurl_dynlib_load(uint32_t *state, const char *const *names, size_t name_count,
                      const knurl_dynlib_function *functions, size_t function_count, char *why, size_t why_size) {
    uint32_t was = ABSENT;
    while (!__atomic_compare_exchange_n(state, &was, (uint32_t)LOADING, 0, __ATOMIC_ACQUIRE, __ATOMIC_ACQUIRE)) {
        if (was == LOADED) {
            return 1;
        }
        was = ABSENT;
        knurl_system_sleep_until_ns(knurl_system_now_ns() + 1000000);
    }
    const int is_loaded = load(names, name_count, functions, function_count, why, why_size);
    __atomic_store_n(state, is_loaded ? (uint32_t)LOADED : (uint32_t)ABSENT, __ATOMIC_RELEASE);
    return is_loaded;
}

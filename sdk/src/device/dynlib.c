/* Libraries loaded at run time. SPDX-License-Identifier: MIT */
#include "device/dynlib.h"

#include "base/system.h"

#include <stdio.h>
#include <string.h>

int knurl_dynlib_load(const char *const *names, size_t name_count, const knurl_dynlib_function *functions,
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
    for (size_t i = 0; library && i < function_count; i++) { /* all are there before any is kept */
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

/* The table of spatial methods. SPDX-License-Identifier: MIT */
#include "grating/method.h"

#include "base/atomic.h"
#include "base/handle.h"

#include <stdio.h>
#include <string.h>

/* S2's 2.5-tick mix reaches (2 + 3 sqrt(1/2))/sqrt(13) = 1.143 A and falls to -(2 + 3 sqrt(2))/sqrt(13). BANDLIMITED's
 * fundamental is 4/pi A; with harmonics it is lower. */
knurl_method knurl_methods[KNURL_BUILT_IN_METHODS + KNURL_OWN_METHODS] = {
    {0},
    [KNURL_METHOD_S1] = {"S1", knurl_s1_height, 1.0, 2.0, 1, 1},
    [KNURL_METHOD_S2] = {"S2", knurl_s2_height, 1.1431, 2.87444560869411535, 0, 0},
    [KNURL_METHOD_BANDLIMITED] = {"bandlimited", knurl_bandlimited_height, 1.2733, 2.54647908947032537, 1, 0},
};

int32_t knurl_method_count = KNURL_BUILT_IN_METHODS;

const char *knurl_method_name(int32_t method) {
    return method > KNURL_METHOD_DEFAULT && method < knurl_load_acquire(&knurl_method_count)
               ? knurl_methods[method].name
               : NULL;
}

knurl_result knurl_method_from_name(const char *name, int32_t *method) {
    char known[640] = ""; /* 19 names of 31 letters */
    const int32_t count = knurl_load_acquire(&knurl_method_count);
    if (KNURL_IS_NULL(name) || KNURL_IS_NULL(method)) {
        return KNURL_ERROR_ARGUMENT;
    }
    for (int32_t i = 1; i < count; i++) {
        const size_t used = strlen(known);
        if (strcmp(knurl_methods[i].name, name) == 0) {
            *method = i;
            return KNURL_OK;
        }
        (void)snprintf(known + used, sizeof known - used, "%s%s",
                       i == 1           ? ""
                       : i == count - 1 ? " or "
                                        : ", ",
                       knurl_methods[i].name);
    }
    return knurl_fail(KNURL_ERROR_UNKNOWN, "method: expected %s, found '%s'", known, name);
}

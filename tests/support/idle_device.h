/* The functions of a device that stays at its origin, accepts any force up to 1 N and does nothing. A test replaces
 * those that it needs. SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_IDLE_DEVICE_H
#define KNURL_TEST_IDLE_DEVICE_H

#include <knurl/device_functions.h>

#include <string.h>

static inline void idle_get_info(void *user, knurl_device_info *info) {
    (void)user;
    info->max_force = 1.0;
}

static inline knurl_result idle_read(void *user, knurl_device_sample *sample) {
    (void)user;
    memset(sample, 0, sizeof *sample);
    return KNURL_OK;
}

static inline knurl_result idle_write(void *user, const double force[3]) {
    (void)user;
    (void)force;
    return KNURL_OK;
}

static inline knurl_device_functions idle_functions(void) {
    knurl_device_functions functions;
    knurl_device_functions_init(&functions, sizeof functions);
    functions.get_info = idle_get_info;
    functions.read = idle_read;
    functions.write = idle_write;
    return functions;
}

#endif

/* Finds the driver for a URI, and lists connected devices. SPDX-License-Identifier: MIT */
#include "device/drivers.h"

#include "base/base.h"

#include <string.h>

static const knurl_driver *const drivers[] = {&knurl_fake_driver, &knurl_touch_driver, &knurl_falcon_driver,
                                              &knurl_rawhid_driver};

#define DRIVER_COUNT (sizeof drivers / sizeof *drivers)

knurl_result knurl_device_open(const char *uri, knurl_device **device) {
    if (KNURL_IS_NULL(uri) || KNURL_IS_NULL(device)) {
        return KNURL_ERROR_ARGUMENT;
    }
    const size_t length = strcspn(uri, ":");
    for (size_t i = 0; i < DRIVER_COUNT; i++) {
        const knurl_driver *driver = drivers[i];
        if (strlen(driver->uri) == length && strncmp(driver->uri, uri, length) == 0) {
            const knurl_result result = driver->open(uri[length] == ':' ? uri + length + 1 : "", device);
            if (!result) {
                knurl_device_register(*device);
            }
            return result;
        }
    }
    return knurl_fail(KNURL_ERROR_UNKNOWN, "device: expected fake, touch, falcon or rawhid, found '%s'", uri);
}

uint32_t knurl_device_list(knurl_device_listing *listings, uint32_t capacity) {
    knurl_listings found = {listings, listings ? capacity : 0, 0};
    for (uint32_t i = 0; i < DRIVER_COUNT; i++) {
        drivers[i]->list(&found);
    }
    return found.count;
}

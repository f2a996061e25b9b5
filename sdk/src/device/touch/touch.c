/* 3D Systems Touch. SPDX-License-Identifier: MIT */
#include "device/driver.h"

static const char reason[] = "its driver (OpenHaptics, loaded at run time) is not in this version";

static void touch_list(knurl_listings *listings) {
    knurl_listings_add(listings, "touch", "3D Systems Touch", "%s", reason);
}

static knurl_result touch_open(const char *options, knurl_device **device) {
    (void)options;
    (void)device;
    return knurl_fail(KNURL_ERROR_UNSUPPORTED, "device 'touch': %s", reason);
}

const knurl_driver knurl_touch_driver = {.uri = "touch", .list = touch_list, .open = touch_open};

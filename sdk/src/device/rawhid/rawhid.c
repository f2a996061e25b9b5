/* raw HID device. SPDX-License-Identifier: MIT */
#include "device/driver.h"

static const char reason[] = "its driver (hidapi) is not in this version";

static void rawhid_list(knurl_listings *listings) {
    knurl_listings_add(listings, "rawhid", "raw HID device", "%s", reason);
}

static knurl_result rawhid_open(const char *options, knurl_device **device) {
    (void)options;
    (void)device;
    return knurl_fail(KNURL_ERROR_UNSUPPORTED, "device 'rawhid': %s", reason);
}

const knurl_driver knurl_rawhid_driver = {.uri = "rawhid", .list = rawhid_list, .open = rawhid_open};

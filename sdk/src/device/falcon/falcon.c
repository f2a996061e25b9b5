/* Novint Falcon. SPDX-License-Identifier: MIT */
#include "device/driver.h"

static const char reason[] = "its driver (libusb) is not in this version";

static void falcon_list(knurl_listings *listings) {
    knurl_listings_add(listings, "falcon", "Novint Falcon", "%s", reason);
}

static knurl_result falcon_open(const char *options, knurl_device **device) {
    (void)options;
    (void)device;
    return knurl_fail(KNURL_ERROR_UNSUPPORTED, "device 'falcon': %s", reason);
}

const knurl_driver knurl_falcon_driver = {.uri = "falcon", .list = falcon_list, .open = falcon_open};

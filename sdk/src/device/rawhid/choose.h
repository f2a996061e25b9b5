/* Chooses the device among the connected HID interfaces, or says why none fits. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_RAWHID_CHOOSE_H
#define KNURL_SRC_RAWHID_CHOOSE_H

#include "device/driver.h"
#include "device/rawhid/geometry.h"
#include "device/rawhid/transport.h"

/* What is looked for. */
typedef struct knurl_rawhid_wanted {
    uint16_t vendor, product; /* 0, 0: whichever is known */
    uint16_t usage_page, usage;
    size_t report_bytes; /* 0: as many as it says, or as is known of it */
} knurl_rawhid_wanted;

/* By `id` ("" or "VID:PID") before the geometry. Errors: KNURL_ERROR_ARGUMENT. */
knurl_result knurl_rawhid_want(const char *id, const knurl_rawhid_geometry *geometry, knurl_rawhid_wanted *wanted);

/* The first that fits, and the length of its reports. Errors: KNURL_ERROR_DEVICE_LOST, KNURL_ERROR_SYSTEM. */
knurl_result knurl_rawhid_choose(const knurl_rawhid_bus *bus, const knurl_rawhid_wanted *wanted,
                                 knurl_rawhid_found *chosen, size_t *report_bytes);

/* All that are known; one entry with a reason where none is there. */
void knurl_rawhid_list(const knurl_rawhid_bus *bus, knurl_listings *listings);

#endif

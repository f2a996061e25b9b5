/* Chooses among the connected HID interfaces, or reports why none fits. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_RAWHID_CHOOSE_H
#define KNURL_SRC_RAWHID_CHOOSE_H

#include "device/driver.h"
#include "device/rawhid/geometry.h"
#include "device/rawhid/transport.h"

/* Search criteria. */
typedef struct knurl_rawhid_wanted {
    uint16_t vendor, product; /* 0, 0: any known device */
    uint16_t usage_page, usage;
    size_t report_bytes; /* 0: as the report descriptor has it, or the known device */
} knurl_rawhid_wanted;

/* Sets the criteria from `id` ("" or "VID:PID"), which overrides the geometry. Errors: KNURL_ERROR_ARGUMENT. */
knurl_result knurl_rawhid_want(const char *id, const knurl_rawhid_geometry *geometry, knurl_rawhid_wanted *wanted);

/* Finds the first interface that fits, and its report length. Errors: KNURL_ERROR_DEVICE_LOST, KNURL_ERROR_SYSTEM. */
knurl_result knurl_rawhid_choose(const knurl_rawhid_bus *bus, const knurl_rawhid_wanted *wanted,
                                 knurl_rawhid_found *chosen, size_t *report_bytes);

/* Lists all known devices; if no device is connected, adds one entry with the reason. */
void knurl_rawhid_list(const knurl_rawhid_bus *bus, knurl_listings *listings);

#endif

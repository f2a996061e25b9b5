/* A growing list of connected devices, filled by drivers. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_LISTINGS_H
#define KNURL_SRC_LISTINGS_H

#include "device/driver.h"

/* Appends a device. `reason`: printf format; "" if the device can be opened. */
void knurl_listings_add(knurl_listings *listings, const char *uri, const char *name, const char *reason, ...)
    KNURL_PRINTF(4, 5);

#endif

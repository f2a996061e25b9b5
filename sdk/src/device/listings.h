/* A growing list of connected devices, filled by drivers. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_LISTINGS_H
#define KNURL_SRC_LISTINGS_H

#include "device/driver.h"

/* One more; `reason` is printf's, "" for a device that can be opened. */
void knurl_listings_add(knurl_listings *listings, const char *uri, const char *name, const char *reason, ...)
    KNURL_PRINTF(4, 5);

#endif

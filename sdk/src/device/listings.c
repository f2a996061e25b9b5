/* A growing list of connected devices, filled by drivers. SPDX-License-Identifier: MIT */
#include "device/listings.h"

#include "base/format.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

void knurl_listings_add(knurl_listings *listings, const char *uri, const char *name, const char *reason, ...) {
    if (listings->count++ < listings->capacity) {
        knurl_device_listing *listing = &listings->to[listings->count - 1];
        va_list arguments;
        memset(listing, 0, sizeof *listing);
        (void)snprintf(listing->uri, sizeof listing->uri, "%s", uri);
        (void)snprintf(listing->name, sizeof listing->name, "%s", name);
        va_start(arguments, reason);
        (void)knurl_format_arguments(listing->reason, sizeof listing->reason, reason, arguments);
        va_end(arguments);
        (void)knurl_text_line(listing->name, sizeof listing->name, listing->name); /* from the device, or a path */
        (void)knurl_text_line(listing->reason, sizeof listing->reason, listing->reason);
    }
}

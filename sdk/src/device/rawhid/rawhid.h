/* The raw HID driver over any bus, for tests; knurl_device_open() takes hidapi's. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_RAWHID_H
#define KNURL_SRC_RAWHID_H

#include "device/driver.h"
#include "device/rawhid/transport.h"

/* What follows "rawhid:". `bus` lives as long as the device. Errors: as knurl_device_open(). */
knurl_result knurl_rawhid_open(const char *options, const knurl_rawhid_bus *bus, knurl_device **device);

#endif

/* The raw HID driver on any bus, for tests; knurl_device_open() uses hidapi's. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_RAWHID_H
#define KNURL_SRC_RAWHID_H

#include "device/driver.h"
#include "device/rawhid/transport.h"

/* options: the URI after "rawhid:". `bus` must outlive the device. Errors: as knurl_device_open(). */
knurl_result knurl_rawhid_open(const char *options, const knurl_rawhid_bus *bus, knurl_device **device);

#endif

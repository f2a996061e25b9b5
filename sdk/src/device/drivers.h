/* The list of drivers. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_DRIVERS_H
#define KNURL_SRC_DRIVERS_H

#include "device/driver.h"

extern const knurl_driver knurl_fake_driver;
extern const knurl_driver knurl_touch_driver;
extern const knurl_driver knurl_falcon_driver;
extern const knurl_driver knurl_rawhid_driver;
extern const knurl_driver knurl_serial_driver;
extern const knurl_driver knurl_dhd_driver;
extern const knurl_driver knurl_inverse3_driver;

#endif

/* The raw HID driver over its simulated device, for tests of all drivers. SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_RAWHID_DOUBLE_H
#define KNURL_TEST_RAWHID_DOUBLE_H

#include "support/double.h"

extern const device_double rawhid_double;

#endif

/* The Touch for the table of faults: the driver over the stub library, in real time. SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_TOUCH_DOUBLE_H
#define KNURL_TEST_TOUCH_DOUBLE_H

#include "support/double.h"

/** The including program is built with KNURL_TEST_STUB, the stub library's path. */
extern const device_double touch_double;

#endif

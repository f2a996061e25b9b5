/* The Falcon's row in the table of faults. SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_FALCON_DOUBLE_H
#define KNURL_TEST_FALCON_DOUBLE_H

#include "support/double.h"

extern const device_double falcon_double;

#endif

/* The doubles of all devices; a new driver's is added to doubles.c. SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_DOUBLES_H
#define KNURL_TEST_DOUBLES_H

#include "support/double.h"

#include <stddef.h>

extern const device_double touch_double, falcon_double, rawhid_double;
extern const device_double *const doubles[];
extern const size_t double_count;

#endif

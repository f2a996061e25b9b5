/* The list of doubles: each driver over a simulation of its device. SPDX-License-Identifier: MIT */
#include "device/doubles.h"

#include "device/dhd/dhd_double.h"
#include "device/faults/functions_double.h"
#include "device/inverse3/inverse3_double.h"
#include "device/rawhid/serial_double.h"

const device_double *const doubles[] = {
    &touch_double, &falcon_double, &rawhid_double, &serial_double, &dhd_double, &inverse3_double, &functions_double,
};
const size_t double_count = sizeof doubles / sizeof *doubles;

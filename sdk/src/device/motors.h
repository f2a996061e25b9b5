/* Heat of a device's motors. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_MOTORS_H
#define KNURL_SRC_MOTORS_H

#include "base/finite.h"

#include <stdint.h>

/* Motor heat at the end of a device's last loop, with its time and clock. */
typedef struct knurl_motor_heat {
    double square;              /* N^2: a steady force with this square would heat the motors as much */
    int64_t at;                 /* ns */
    int64_t (*now)(void *user); /* null if no loop has run */
    void *user;
} knurl_motor_heat;

#endif

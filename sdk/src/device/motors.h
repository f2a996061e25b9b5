/* Heat of a device's motors. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_MOTORS_H
#define KNURL_SRC_MOTORS_H

#include "base/finite.h"

#include <stdint.h>

/* What a device's latest loop left: how warm the motors were, when, and by which clock. */
typedef struct knurl_motor_heat {
    double square;              /* N^2: as a force of this square makes them in the long run */
    int64_t at;                 /* ns */
    int64_t (*now)(void *user); /* null: no loop has run */
    void *user;
} knurl_motor_heat;

#endif

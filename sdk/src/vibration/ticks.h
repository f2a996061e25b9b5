/* Periods counted in ticks. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_TICKS_H
#define KNURL_SRC_TICKS_H

#include "base/finite.h"

#include <math.h>

/* The longest period that is played: 10 s at 100 kHz. */
#define KNURL_MAX_PERIOD_TICKS 1e6

/* A period times an update rate is a few ulp off: 0.00225 * 1000 is not 2.25 in doubles. Every decision (parity,
 * Algorithm 6's thresholds, half a period) falls on quarters of a tick, so a period within 1e-9 of a quarter is set to
 * it. 1e-9 is far above the error of one product (2e-16) and far below any difference that could be felt. */
static inline double knurl_snap_ticks(double ticks) {
    const double quarters = floor(4.0 * ticks + 0.5);
    return fabs(4.0 * ticks - quarters) <= 1e-9 * quarters ? 0.25 * quarters : ticks;
}

#endif

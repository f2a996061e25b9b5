/* Phases in cycles. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_PHASE_H
#define KNURL_SRC_PHASE_H

#include "base/finite.h"

/* Adding and then subtracting it rounds to a whole number, because its unit in the last place is 1. base/finite.h
 * ensures that no compiler removes the two operations. */
#define KNURL_WHOLE 6755399441055744.0 /* 3 * 2^51 */

/* The nearest whole number. Exact to 2^51; beyond, a double has no phase left, and this is some whole number near it. A
 * number that is not finite stays so. */
static inline double knurl_nearest_cycle(double phase) {
    return (phase + KNURL_WHOLE) - KNURL_WHOLE;
}

/* floor(), which is a call unless a compiler may use SSE4.1. */
static inline double knurl_whole_cycles(double phase) {
    const double nearest = knurl_nearest_cycle(phase);
    return nearest > phase ? nearest - 1.0 : nearest;
}

/* Which half of its cycle a phase is in. */
static inline int knurl_first_half(double phase) {
    return phase - knurl_whole_cycles(phase) < 0.5;
}

#endif

/* Positions and phases of a method whose ridges are at surface coordinates. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_FOLLOW_H
#define KNURL_SRC_FOLLOW_H

#include "base/finite.h"
#include "grating/method.h"

#include <math.h>

/* m: the largest distance that a velocity makes in one tick. */
#define KNURL_FARTHEST 1e6

/* The distance of one tick, m. */
static inline double knurl_distance(double speed, double period) {
    const double moved = speed * period;
    return fabs(moved) < KNURL_FARTHEST ? moved : 0.0;
}

/* Moves the position on by one tick: without coordinates the velocity is integrated. Returns it, so that it stays in
 * registers. */
static inline knurl_along knurl_follow(knurl_grating_state *s, knurl_along position, knurl_along velocity,
                                       double period, int32_t has_position) {
    if (!has_position) {
        position.x = s->tracked[0] + knurl_distance(velocity.x, period);
        position.y = s->tracked[1] + knurl_distance(velocity.y, period);
    }
    s->tracked[0] = position.x;
    s->tracked[1] = position.y;
    return position;
}

/* Adding and then subtracting it rounds to a whole number, because its unit in the last place is 1. base/finite.h
 * ensures that no compiler removes the two operations. */
#define KNURL_TO_WHOLE 6755399441055744.0 /* 3 * 2^51 */

/* The nearest whole number. Exact to 2^51; beyond, a double has no phase left, and this is some whole number near it. A
 * number that is not finite stays so. */
static inline double knurl_nearest_cycle(double phase) {
    return (phase + KNURL_TO_WHOLE) - KNURL_TO_WHOLE;
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

/* The position of a method whose ridges are at surface coordinates. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_FOLLOW_H
#define KNURL_SRC_FOLLOW_H

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

#endif

/* The heat of a device's motors, and the force that they can still give. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_HEAT_H
#define KNURL_SRC_HEAT_H

#include "base/base.h"

#include "guard/hip_facts.h"

#include <knurl/base.h>

/* Share of the heat that continuous_force makes in the long run from which on the force limit falls. Any value below 1
 * keeps the heat below that; with this one the full force lasts for 90 % of the way, and falls slowly enough over the
 * rest for a hand to follow. */
#define KNURL_HEAT_WARM 0.9

/* Heat of motors under a force: square' = (F^2 - square)/time. In N^2 it is the same whatever the continuous force. */
typedef struct knurl_heat {
    double square;    /* N^2: of the force that makes the motors as warm in the long run */
    double share;     /* of the way to where the force takes it, a tick */
    double per_force; /* 1/continuous^2 */
    double warm;      /* N^2: from here on the limit falls; infinite: there is no limit but max_force */
    double most;      /* N^2: continuous^2, which it is kept from exceeding; or infinite */
    double continuous;
    double excess; /* (max_force/continuous)^2 - 1 */
    double max_force;
} knurl_heat;

/* limits: 0: the heat is counted, but no limit falls. */
void knurl_heat_init(knurl_heat *heat, const knurl_hip_facts *facts, int limits);

/* Slow path of knurl_heat_limit(). */
double knurl_heat_limit_warm(const knurl_heat *heat) KNURL_NONBLOCKING;

/* N: the greatest force now: max_force while cool, falling smoothly to the continuous force. */
static inline double knurl_heat_limit(const knurl_heat *heat) {
    return KNURL_UNLIKELY(!(heat->square <= heat->warm)) ? knurl_heat_limit_warm(heat) : heat->max_force;
}

/* Heat after a step from `square` to `next`. Motors that are too warm already, by an earlier use, stay so. */
static inline double knurl_heat_cap(const knurl_heat *heat, double next) {
    return KNURL_LIKELY(next <= heat->most) || next <= heat->square ? next : heat->most;
}

/* Adds a force that was played for a tick, N^2. */
static inline void knurl_heat_add(knurl_heat *heat, double force2) {
    heat->square = knurl_heat_cap(heat, heat->square + heat->share * (force2 - heat->square));
}

/* The closed form of `ticks` (>= 0) times knurl_heat_add(). */
void knurl_heat_hold(knurl_heat *heat, double force2, double ticks) KNURL_NONBLOCKING;

/* 0 cold to 1: as warm as the continuous force makes them in the long run. */
static inline double knurl_heat_theta(const knurl_heat *heat) {
    return heat->square * heat->per_force;
}

#endif

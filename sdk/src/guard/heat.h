/* Heat of a device's motors, and the force that it leaves. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_HEAT_H
#define KNURL_SRC_HEAT_H

#include "base/base.h"
#include "base/vec3.h"

#include "guard/hip_facts.h"

#include <knurl/base.h>

/* Share of the heat of a lasting continuous_force above which the force limit falls. Any value below 1 keeps the heat
 * below that. With this one the full force lasts until 90 % of the heat is reached, and the limit then falls slowly
 * enough for a hand to follow. */
#define KNURL_HEAT_WARM 0.9

/* Heat of motors under a force: square' = (F^2 - square)/time. In N^2 it does not depend on the continuous force. */
typedef struct knurl_heat {
    double square;    /* N^2: of the constant force that would make the motors as warm */
    double share;     /* of the change towards a force's heat, per tick */
    double per_force; /* 1/continuous^2 */
    double warm;      /* N^2: the limit falls above this; infinite: max_force is the only limit */
    double most;      /* N^2: upper limit of `square`: continuous^2, or infinite */
    double continuous;
    double excess; /* (max_force/continuous)^2 - 1 */
    double max_force;
} knurl_heat;

/* limits: 0: counts the heat, but never lowers the force limit. */
void knurl_heat_init(knurl_heat *heat, const knurl_hip_facts *facts, int limits);

/* Slow path of knurl_heat_limit(). */
double knurl_heat_limit_warm(const knurl_heat *heat) KNURL_NONBLOCKING;

/* N: the force limit now: max_force while cool, falling smoothly to the continuous force. */
static inline double knurl_heat_limit(const knurl_heat *heat) {
    return KNURL_UNLIKELY(!(heat->square <= heat->warm)) ? knurl_heat_limit_warm(heat) : heat->max_force;
}

/* Heat after a step from `square` to `next`. Motors that are already too warm from an earlier use may stay so. */
static inline double knurl_heat_cap(const knurl_heat *heat, double next) {
    return KNURL_LIKELY(next <= heat->most) ? next : knurl_min(next, knurl_max(heat->most, heat->square));
}

/* Adds a force that was played for a tick, N^2. */
static inline void knurl_heat_add(knurl_heat *heat, double force2) {
    heat->square = knurl_heat_cap(heat, heat->square + heat->share * (force2 - heat->square));
}

/* Closed form of `ticks` (>= 0) calls of knurl_heat_add(). */
void knurl_heat_hold(knurl_heat *heat, double force2, double ticks) KNURL_NONBLOCKING;

/* 0: cold; 1: as warm as a lasting continuous force makes them. */
static inline double knurl_heat_theta(const knurl_heat *heat) {
    return heat->square * heat->per_force;
}

#endif

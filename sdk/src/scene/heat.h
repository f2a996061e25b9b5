/* The heat of a device's motors, and the force that they can still give. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_HEAT_H
#define KNURL_SRC_HEAT_H

#include "base/base.h"

#include "scene/hip_facts.h"

#include <knurl/base.h>

/* theta at which the force limit begins to fall. Any value below 1 keeps theta below 1; with this one the full force
 * lasts for 90 % of the way, and falls slowly enough over the rest for a hand to follow. */
#define KNURL_HEAT_WARM 0.9

/* Heat of motors under a force: theta' = ((F/continuous)^2 - theta)/time. */
typedef struct knurl_heat {
    double theta;     /* 0 cold to 1: as warm as the continuous force makes them in the long run */
    double share;     /* of the way to where the force takes theta, a tick */
    double per_force; /* 1/continuous^2 */
    double continuous;
    double excess; /* (max_force/continuous)^2 - 1; 0: there is no limit but max_force */
    double max_force;
} knurl_heat;

void knurl_heat_init(knurl_heat *heat, const knurl_hip_facts *facts);

/* What is rare: called by knurl_heat_limit(). */
double knurl_heat_limit_warm(const knurl_heat *heat) KNURL_NONBLOCKING;

/* N: the greatest force now: max_force while cool, falling smoothly to the continuous force as theta nears 1. */
static inline double knurl_heat_limit(const knurl_heat *heat) {
    return KNURL_UNLIKELY(!(heat->theta <= KNURL_HEAT_WARM) && heat->excess != 0.0) ? knurl_heat_limit_warm(heat)
                                                                                    : heat->max_force;
}

/* What was played for a tick, N^2. */
static inline void knurl_heat_add(knurl_heat *heat, double force2) {
    heat->theta += heat->share * (force2 * heat->per_force - heat->theta);
    heat->theta = KNURL_LIKELY(heat->theta < 1.0) || heat->excess == 0.0 ? heat->theta : 1.0;
}

/* For as many ticks, >= 0: the closed form. */
void knurl_heat_hold(knurl_heat *heat, double force2, double ticks) KNURL_NONBLOCKING;

/* The same heat whatever the continuous force: N^2, of the force that makes the motors as warm in the long run. */
double knurl_heat_get(const knurl_heat *heat) KNURL_NONBLOCKING;
void knurl_heat_set(knurl_heat *heat, double square) KNURL_NONBLOCKING;

#endif

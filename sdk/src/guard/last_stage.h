/* The last stage: every force passes it before a device. In device axes it scales the force (to 0 in a halt), limits
 * its change and its length, and counts the heat. A HIP has one for a scene's forces, a loop for its callback's. Pure
 * computation. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_LAST_STAGE_H
#define KNURL_SRC_LAST_STAGE_H

#include "base/base.h"
#include "base/vec3.h"
#include "guard/hip_facts.h"

#include <knurl/hip.h>

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

typedef struct knurl_last_stage {
    double force[3]; /* N, device axes: as sent at the last tick */
    double slew;     /* N that the force may change in a tick, unless it falls */
    int32_t release; /* 1: after a squeeze, until the force has fallen: its fall is limited too */
    knurl_heat heat;
} knurl_last_stage;

/* protections: only KNURL_PROTECT_SLEW and _HEAT matter. slew_rate: N/s, or KNURL_DEFAULT. stage: zeroed, or
 * set up before; its heat is kept. facts: complete. */
void knurl_last_stage_init(knurl_last_stage *stage, uint32_t protections, double slew_rate,
                           const knurl_hip_facts *facts);

/* Slow path of knurl_last_stage_limit(): scales a force and limits its change. */
void knurl_last_stage_limit_change(knurl_last_stage *stage, double gain, double steps, double force[3],
                                   uint32_t *flags) KNURL_NONBLOCKING;

/* Limits a force (N, device axes) in place and records it as sent. gain: 0 to 1; 0: no force. steps: N, jumps of
 * textures in this tick, which the slew limit allows. flags: KNURL_TICK_SQUEEZED is read. Returns the force's length,
 * N. If that is not finite, no force was recorded: the caller calls knurl_last_stage_note() with zeros. */
static inline double knurl_last_stage_limit(knurl_last_stage *stage, double gain, double steps, double force[3],
                                            uint32_t *flags) {
    double change[3];
    const double free = stage->slew + steps;
    vec3_sub(force, stage->force, change);
    if (KNURL_UNLIKELY(gain < 1.0 || !(vec3_dot(change, change) <= free * free))) {
        double limited[3]; /* a copy, so that `force` itself can stay in registers */
        vec3_copy(force, limited);
        knurl_last_stage_limit_change(stage, gain, steps, limited, flags);
        vec3_copy(limited, force);
    } else {
        stage->release = 0;
    }
    double length = vec3_length(force);
    const double most = knurl_heat_limit(&stage->heat);
    if (KNURL_UNLIKELY(!(length <= most))) { /* also if either is NaN, which makes the force NaN */
        vec3_scale(most / length, force, force);
        *flags |= most < stage->heat.max_force ? KNURL_TICK_HEAT : KNURL_TICK_FORCE_LIMIT;
        length = vec3_length(force);
        if (!knurl_is_finite(length)) {
            return length;
        }
    }
    vec3_copy(force, stage->force);
    knurl_heat_add(&stage->heat, length * length);
    return length;
}

/* Records a force (N, device axes) as sent in a tick that was not limited here: zero in most cases. */
void knurl_last_stage_note(knurl_last_stage *stage, const double force[3]) KNURL_NONBLOCKING;

#endif

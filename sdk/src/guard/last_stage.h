/* The last stage: every force passes it before a device. In device axes it scales the force (to 0 in a halt), limits
 * its change and its length, and counts the heat. A HIP has one for a scene's forces, a loop for its callback's. Pure
 * computation. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_LAST_STAGE_H
#define KNURL_SRC_LAST_STAGE_H

#include "base/vec3.h"
#include "guard/heat.h"

#include <knurl/hip.h>

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

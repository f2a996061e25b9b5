/* The protections of a HIP: what keeps a hand, and a device's motors, from what a scene may ask for; one call before
 * the forces and one after. Pure computation, a few words of state. Units are the scene's, so that a tick need not
 * convert. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_GUARD_H
#define KNURL_SRC_GUARD_H

#include "base/vec3.h"
#include "scene/bounds.h"
#include "scene/heat.h"
#include "scene/passivity.h"

/* Of one HIP. */
typedef struct knurl_guard {
    double force[3]; /* N, scene: as sent at the latest tick */
    double entry;    /* m that the felt depth may grow in a tick */
    double slew;     /* N that the force may grow or turn in a tick */
    double gain;     /* on the force of this tick, 0 to 1 */
    int32_t clamp;   /* 1: within bounds */
    knurl_passivity passivity;
    knurl_heat heat;
    knurl_bounds bounds;
} knurl_guard;

/* Sets the protections up; the motors stay as warm as they were. guard: zeroed, or set up before. facts: complete. */
void knurl_guard_init(knurl_guard *guard, const knurl_hip_desc *desc, const knurl_hip_facts *facts, double scale);

/* Stiffness and amplitude of a wall within a device's bounds. */
void knurl_guard_limit_wall(const knurl_bounds *bounds, knurl_wall *wall) KNURL_NONBLOCKING;

/* Stiffness and amplitude within bounds, where that was asked for. */
static inline void knurl_guard_clamp(const knurl_guard *guard, knurl_wall *wall) {
    if (guard->clamp) {
        knurl_guard_limit_wall(&guard->bounds, wall);
    }
}

/* A tick begins, of whose force `attenuation` is not sent. */
static inline void knurl_guard_begin(knurl_guard *guard, double attenuation) {
    guard->gain = knurl_is_within(attenuation, 0.0, 1.0) ? 1.0 - attenuation : 0.0;
    if (guard->passivity.busy) {
        knurl_passivity_follow(&guard->passivity);
    }
}

/* The depth that is felt grows as a ramp; while no force is sent, it begins anew. */
static inline void knurl_guard_enter(const knurl_guard *guard, knurl_wall *wall, uint32_t *flags) {
    const double most = wall->contact->depth + guard->entry;
    if (guard->gain == 0.0) {
        wall->contact->depth = 0.0;
        return;
    }
    if (-wall->felt > most) {
        *flags |= KNURL_TICK_ENTRY;
        wall->felt = -most;
    }
    wall->contact->depth = wall->felt < 0.0 ? -wall->felt : 0.0;
}

/* Before the forces: each wall as it is to be felt. Bounded where that was asked for; its depth grows as a ramp; and it
 * is softer where it has shaken the hand by itself. */
static inline void knurl_guard_before(knurl_guard *guard, knurl_wall *walls, uint32_t count, uint32_t *flags) {
    for (uint32_t i = 0; i < count; i++) {
        knurl_wall *wall = &walls[i];
        knurl_guard_clamp(guard, wall);
        knurl_guard_enter(guard, wall, flags);
        if ((wall->stiffness > guard->passivity.safe) | guard->passivity.alarmed) {
            knurl_passivity_watch(&guard->passivity, wall, flags);
        }
        wall->watched = guard->passivity.busy;
    }
}

/* After the forces: their sum as it is sent, in place: what the attenuation leaves of it, within slew_rate of the
 * latest but for the textures' own steps and what falls, within what the motors can do now. Returns its length, N; NaN
 * or infinite where the force was. */
double knurl_guard_after(knurl_guard *guard, const knurl_wall *walls, uint32_t count, double force[3],
                         uint32_t *flags) KNURL_NONBLOCKING;

/* A force was sent without a tick, for as long as a tick. */
void knurl_guard_sent(knurl_guard *guard, const double force[3]) KNURL_NONBLOCKING;

/* After a tick that is not to be trusted: no force was sent. The motors are as warm as they are. */
void knurl_guard_reset(knurl_guard *guard) KNURL_NONBLOCKING;

#endif

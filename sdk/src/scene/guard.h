/* The protections of a HIP: what keeps a hand, and a device's motors, from what a scene may ask for. In a tick: begin;
 * before and after each contact's force; then limit their sum. Pure computation, a few words of state. Units are the
 * scene's, so that a tick need not convert. SPDX-License-Identifier: MIT */
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

/* Before a contact's force: its wall as it is to be felt. Bounded where that was asked for; its depth grows as a ramp;
 * and it is softer where it has shaken the hand by itself. */
static inline void knurl_guard_before(knurl_guard *guard, knurl_wall *wall, uint32_t *flags) {
    knurl_guard_clamp(guard, wall);
    knurl_guard_enter(guard, wall, flags);
    if ((wall->stiffness > guard->passivity.safe) | guard->passivity.alarmed) {
        knurl_passivity_watch(&guard->passivity, wall, flags);
    }
}

/* After it: N, the step of this tick's texture, which is let through. What it moves of a hand is no shaking. */
static inline double knurl_guard_after(knurl_guard *guard, const knurl_wall *wall) {
    knurl_wall_state *contact = wall->contact;
    const double step = fabs(wall->height - contact->height);
    if (guard->passivity.busy) {
        guard->passivity.moved += step;
        guard->passivity.crossings += (wall->height > 0.0) != (contact->height > 0.0);
    }
    contact->height = wall->height;
    return wall->stiffness * step;
}

/* What is rare: called by knurl_guard_limit(). most: N that the force may grow or turn by. */
void knurl_guard_attenuate(const knurl_guard *guard, double force[3]) KNURL_NONBLOCKING;
void knurl_guard_limit_slew(const knurl_guard *guard, double most, double force[3], uint32_t *flags) KNURL_NONBLOCKING;

/* The sum of all forces as it is sent, in place: what the attenuation leaves of it, within slew_rate of the latest but
 * for the textures' own steps (N) and what falls, within what the motors can do now. Returns its length, N; NaN or
 * infinite where the force was. */
static inline double knurl_guard_limit(knurl_guard *guard, double steps, double force[3], uint32_t *flags) {
    double change[3];
    double free = guard->slew + steps;
    if (guard->gain < 1.0) {
        knurl_guard_attenuate(guard, force);
        free = guard->slew + guard->gain * steps;
    }
    vec3_sub(force, guard->force, change);
    if (!(vec3_dot(change, change) <= free * free)) {
        knurl_guard_limit_slew(guard, free, force, flags);
    }
    double length = vec3_length(force);
    const double most = knurl_heat_limit(&guard->heat);
    if (length > most) {
        vec3_scale(most / length, force, force);
        *flags |= most < guard->heat.max_force ? KNURL_TICK_HEAT : KNURL_TICK_FORCE_LIMIT;
        length = vec3_length(force);
    }
    if (knurl_is_finite(length)) {
        vec3_copy(force, guard->force);
        knurl_heat_add(&guard->heat, length * length);
    }
    return length;
}

/* A force was sent without a tick, for as long as a tick. */
void knurl_guard_sent(knurl_guard *guard, const double force[3]) KNURL_NONBLOCKING;

/* After a tick that is not to be trusted: no force was sent. The motors are as warm as they are. */
void knurl_guard_reset(knurl_guard *guard) KNURL_NONBLOCKING;

#endif

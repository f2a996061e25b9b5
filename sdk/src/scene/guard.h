/* The protections of a HIP: limits on what a scene may do to a hand and to a device's motors. A tick calls begin, then
 * before and after around each contact's force, then limit on their sum. Pure computation. Units are the scene's, so
 * that a tick need not convert. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_GUARD_H
#define KNURL_SRC_GUARD_H

#include "base/vec3.h"
#include "scene/bounds.h"
#include "scene/heat.h"
#include "scene/passivity.h"

/* Of one HIP. */
typedef struct knurl_guard {
    double force[3]; /* N, scene: as sent at the latest tick */
    double entry;    /* m that a depth may grow in a tick */
    double slew;     /* N that the force may change in a tick, except where it falls */
    double gain;     /* on the force of this tick, 0 to 1 */
    int32_t clamp;   /* 1: within bounds */
    int32_t release; /* 1: after a squeeze, until the force is down: its fall is limited too */
    knurl_passivity passivity;
    knurl_heat heat;
    knurl_bounds bounds;
} knurl_guard;

/* Sets the protections up; the motors stay as warm as they were. guard: zeroed, or set up before. facts: complete. */
void knurl_guard_init(knurl_guard *guard, const knurl_hip_desc *desc, const knurl_hip_facts *facts);

/* Sets what depends on the workspace's scale: scene metres a device metre. */
void knurl_guard_set_scale(knurl_guard *guard, const knurl_hip_desc *desc, const knurl_hip_facts *facts,
                           double scale) KNURL_NONBLOCKING;

/* Stiffness and amplitude of a wall within a device's bounds. */
void knurl_guard_limit_wall(const knurl_bounds *bounds, knurl_wall *wall) KNURL_NONBLOCKING;

/* A tick begins. attenuation: the share of its force, 0 to 1, that will not be sent. */
static inline void knurl_guard_begin(knurl_guard *guard, double attenuation) {
    guard->gain = attenuation == 0.0 ? 1.0 : knurl_is_within(attenuation, 0.0, 1.0) ? 1.0 - attenuation : 0.0;
    if (guard->passivity.busy) {
        knurl_passivity_follow(&guard->passivity);
    }
}

/* The entry ramp: limits how fast the depth grows. It starts again from 0 while no force is sent. */
static inline void knurl_guard_enter(const knurl_guard *guard, knurl_wall *wall, uint32_t *flags) {
    const double most = wall->contact->depth + guard->entry;
    if (KNURL_UNLIKELY(guard->gain == 0.0)) {
        wall->contact->depth = 0.0;
        return;
    }
    if (KNURL_UNLIKELY(-wall->z > most)) {
        *flags |= KNURL_TICK_ENTRY;
        wall->z = -most;
    }
    wall->contact->depth = knurl_max(-wall->z, 0.0);
}

/* Before a contact's force: clamps its wall, limits its depth, softens it after the passivity controller's alarm. */
static inline void knurl_guard_before(knurl_guard *guard, knurl_wall *wall, uint32_t *flags) {
    if (KNURL_UNLIKELY(guard->clamp)) {
        knurl_wall limited = *wall; /* a copy, so that `wall` itself can stay in registers */
        knurl_guard_limit_wall(&guard->bounds, &limited);
        *wall = limited;
    }
    knurl_guard_enter(guard, wall, flags);
    if (wall->stiffness > guard->passivity.safe || guard->passivity.alarmed) {
        knurl_passivity_watch(&guard->passivity, wall, flags);
    }
}

/* After the force: returns the texture's own step in this tick, N, which the slew limit allows. The step is told to the
 * passivity controller, which must not take a hand that a texture moves for an unstable wall. */
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

/* Attenuates a force and limits its change, both rare. */
void knurl_guard_limit_change(knurl_guard *guard, double steps, double force[3], uint32_t *flags) KNURL_NONBLOCKING;

/* Limits the sum of all forces, in place: attenuation, then the slew limit (not of the textures' own steps, N, nor of
 * falling forces, unless after a squeeze), then the motors' limit. Returns its length, N; NaN where the force is. */
static inline double knurl_guard_limit(knurl_guard *guard, double steps, double force[3], uint32_t *flags) {
    double change[3];
    const double free = guard->slew + steps;
    vec3_sub(force, guard->force, change);
    if (KNURL_UNLIKELY(guard->gain < 1.0 || !(vec3_dot(change, change) <= free * free))) {
        double limited[3]; /* a copy, so that `force` itself can stay in registers */
        vec3_copy(force, limited);
        knurl_guard_limit_change(guard, steps, limited, flags);
        vec3_copy(limited, force);
    } else {
        guard->release = 0;
    }
    double length = vec3_length(force);
    const double most = knurl_heat_limit(&guard->heat);
    if (KNURL_UNLIKELY(length > most)) {
        vec3_scale(most / length, force, force);
        *flags |= most < guard->heat.max_force ? KNURL_TICK_HEAT : KNURL_TICK_FORCE_LIMIT;
        length = vec3_length(force);
    }
    if (KNURL_LIKELY(knurl_is_finite(length))) {
        vec3_copy(force, guard->force);
        knurl_heat_add(&guard->heat, length * length);
    }
    return length;
}

/* Counts a force that was sent for one period without a tick. */
void knurl_guard_note_sent(knurl_guard *guard, const double force[3]) KNURL_NONBLOCKING;

/* After a tick with invalid input: no force was sent. The motors keep their heat. */
void knurl_guard_reset(knurl_guard *guard) KNURL_NONBLOCKING;

#endif

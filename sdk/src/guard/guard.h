/* Protections that depend on contacts: limits on the walls of a scene. A tick calls begin, then before and after around
 * each contact's force. The sum of the forces goes to the last stage (last_stage.h). Pure computation. Units are the
 * scene's, so that a tick need not convert. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_GUARD_H
#define KNURL_SRC_GUARD_H

#include "base/vec3.h"
#include "guard/hip_facts.h"
#include "guard/passivity.h"

/* N s/m: damping that the lightest hand adds to that of its device; a device that is felt is held, at least loosely. A
 * finger tip alone has some N s/m, and more the harder it holds (Hajian and Howe 1997; Hasser and Cutkosky 2002). */
#define KNURL_LIGHTEST_HAND 2.0

/* Limits of walls and textures on a device. */
typedef struct knurl_bounds {
    double scale;
    double friction; /* N s/m, of device and lightest hand */
    double lag;      /* s: half a period and the delay */
    double max_stiffness;
    double max_force;
    double continuous_force;
    double quantum; /* m, scene */
} knurl_bounds;

/* scale: scene metres a device metre. */
void knurl_bounds_init(knurl_bounds *bounds, const knurl_hip_facts *facts, double scale) KNURL_NONBLOCKING;

/* N/m, at the device. damping: N s/m, scene. Stability limit (b + B)/(T/2 + delay); its minimum with max_stiffness. */
double knurl_bounds_stability(const knurl_bounds *bounds, double damping) KNURL_NONBLOCKING;
double knurl_bounds_stiffness(const knurl_bounds *bounds, double damping) KNURL_NONBLOCKING;

/* m: largest amplitude at a stiffness (N/m, scene): its swing within max_force, its rms within continuous_force. */
double knurl_bounds_amplitude(const knurl_bounds *bounds, double stiffness, int32_t method) KNURL_NONBLOCKING;

/* m/s in device metres: the fastest growth of a depth under the entry ramp. */
#define KNURL_ENTRY_SPEED_MAX 0.5

/* Of one HIP. */
typedef struct knurl_guard {
    double entry;  /* m that a depth may grow in a tick */
    double gain;   /* factor of this tick's force, 0 to 1 */
    int32_t clamp; /* 1: clamp walls to `bounds` */
    knurl_passivity passivity;
    knurl_bounds bounds;
    double effect_stiffness, effect_damping; /* N/m, N s/m: limits of all effects together; infinite: protection off */
} knurl_guard;

/* Sets the protections up. facts: complete. */
void knurl_guard_init(knurl_guard *guard, const knurl_hip_desc *desc, const knurl_hip_facts *facts);

/* Sets the values that depend on the workspace's scale: scene metres a device metre. */
void knurl_guard_set_scale(knurl_guard *guard, const knurl_hip_desc *desc, const knurl_hip_facts *facts,
                           double scale) KNURL_NONBLOCKING;

/* Clamps stiffness and amplitude of a wall to a device's limits. */
void knurl_guard_limit_wall(const knurl_bounds *bounds, knurl_wall *wall) KNURL_NONBLOCKING;

/* Begins a tick. attenuation: the share of its force, 0 to 1, that will not be sent. */
static inline void knurl_guard_begin(knurl_guard *guard, double attenuation) {
    guard->gain = attenuation == 0.0 ? 1.0 : knurl_is_within(attenuation, 0.0, 1.0) ? 1.0 - attenuation : 0.0;
    if (guard->passivity.busy) {
        knurl_passivity_follow(&guard->passivity);
    }
}

/* The entry ramp: limits how fast the depth grows. It starts again from 0 while no force is sent. */
static inline void knurl_guard_enter(const knurl_guard *guard, knurl_wall *wall, uint32_t *flags) {
    const double most = wall->state->depth + guard->entry;
    if (KNURL_UNLIKELY(guard->gain <= 0.0)) {
        wall->state->depth = 0.0;
        return;
    }
    if (KNURL_UNLIKELY(-wall->z > most)) {
        *flags |= KNURL_TICK_ENTRY;
        wall->z = -most;
    }
    wall->state->depth = knurl_max(-wall->z, 0.0);
}

/* Before a contact's force: clamps its wall, limits its depth, and softens it during a passivity alarm. */
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

/* After the force: returns the texture's own step in this tick, N, which the slew limit allows. Also reports the step
 * to the passivity controller, which must not mistake a hand that a texture moves for an unstable wall. */
static inline double knurl_guard_after(knurl_guard *guard, const knurl_wall *wall) {
    knurl_wall_state *state = wall->state;
    const double step = fabs(wall->height - state->height);
    if (knurl_passivity_counts(&guard->passivity)) {
        guard->passivity.moved += step;
        guard->passivity.crossings += (wall->height > 0.0) != (state->height > 0.0);
    }
    state->height = wall->height;
    return wall->stiffness * step;
}

#endif

/* The protections. SPDX-License-Identifier: MIT */
#include "scene/guard.h"

#include <string.h>

/* s in which a force may grow from none to max_force, where no slew_rate is given. */
#define SLEW_TIME 0.005

void knurl_guard_init(knurl_guard *guard, const knurl_hip_desc *desc, const knurl_hip_facts *facts) {
    const double period = 1.0 / facts->rate;
    const double heat = knurl_heat_get(&guard->heat);
    memset(guard, 0, sizeof *guard);
    knurl_heat_init(&guard->heat, facts);
    if (!(desc->protections & KNURL_PROTECT_HEAT)) {
        guard->heat.excess = 0.0;
    }
    knurl_heat_set(&guard->heat, heat);
    knurl_passivity_init(&guard->passivity, facts);
    const double slew = desc->slew_rate > 0.0 ? desc->slew_rate : facts->max_force / SLEW_TIME;
    guard->slew = desc->protections & KNURL_PROTECT_SLEW ? slew * period : HUGE_VAL;
    guard->clamp = (int32_t)desc->clamp;
}

void knurl_guard_set_scale(knurl_guard *guard, const knurl_hip_desc *desc, const knurl_hip_facts *facts, double scale) {
    const double period = 1.0 / facts->rate;
    guard->entry = desc->protections & KNURL_PROTECT_ENTRY ? KNURL_ENTRY_SPEED_MAX * scale * period : HUGE_VAL;
    knurl_passivity_set_scale(&guard->passivity, (desc->protections & KNURL_PROTECT_PASSIVITY) != 0, facts, scale);
    knurl_bounds_init(&guard->bounds, facts, scale);
}

void knurl_guard_limit_wall(const knurl_bounds *bounds, knurl_wall *wall) {
    const knurl_material_desc *material = wall->material;
    const double most = knurl_bounds_stiffness(bounds, material->damping) / bounds->scale;
    wall->stiffness = wall->stiffness < most ? wall->stiffness : most;
    const double highest = knurl_bounds_amplitude(bounds, wall->stiffness, material->method);
    wall->amplitude = wall->amplitude < highest ? wall->amplitude : highest;
}

/* Falling force is not limited: the change is measured from the nearest point between no force and the latest one.
 * After a squeeze it is, from the latest one, as long as it falls. most: N that the force may change by. */
static void limit_slew(knurl_guard *guard, double most, double force[3], uint32_t *flags) {
    double from[3];
    double change[3];
    const double latest2 = vec3_dot(guard->force, guard->force);
    const double along = vec3_dot(force, guard->force);
    const int from_latest = guard->release || along >= latest2;
    vec3_scale(from_latest ? 1.0 : along <= 0.0 ? 0.0 : along / latest2, guard->force, from);
    vec3_sub(force, from, change);
    const double change2 = vec3_dot(change, change);
    guard->release &= change2 > most * most && (along < latest2 || (*flags & KNURL_TICK_SQUEEZED));
    if (change2 > most * most) {
        vec3_madd(from, most / sqrt(change2), change, force);
        *flags |= KNURL_TICK_SLEW;
    }
}

/* The gain applies to the force after it is cut to what the motors can give, so that a ramp's full length is used. */
static void attenuate(const knurl_guard *guard, double force[3]) {
    const double length = vec3_length(force);
    const double most = knurl_heat_limit(&guard->heat);
    vec3_scale(length > most ? guard->gain * (most / length) : guard->gain, force, force);
}

void knurl_guard_limit_change(knurl_guard *guard, double steps, double force[3], uint32_t *flags) {
    const double free = guard->slew + guard->gain * steps;
    guard->release |= (*flags & KNURL_TICK_SQUEEZED) != 0;
    if (guard->gain < 1.0) {
        attenuate(guard, force);
    }
    if (!(vec3_distance2(force, guard->force) <= free * free)) {
        limit_slew(guard, free, force, flags);
    } else {
        guard->release = 0;
    }
}

void knurl_guard_note_sent(knurl_guard *guard, const double force[3]) {
    vec3_copy(force, guard->force);
    knurl_heat_add(&guard->heat, vec3_dot(force, force));
}

void knurl_guard_reset(knurl_guard *guard) {
    guard->force[0] = guard->force[1] = guard->force[2] = 0.0;
    guard->release = 0;
    knurl_heat_add(&guard->heat, 0.0);
}

/* The protections. SPDX-License-Identifier: MIT */
#include "scene/guard.h"

#include <string.h>

/* theta from which on the force limit comes down. Any value keeps theta below 1; this one leaves the full force for 90
 * % of the way and takes it back over the last tenth, in which a hand can let go of what it presses. */
#define WARM 0.9

/* s in which a force may grow from none to max_force, where no slew_rate is given. */
#define SLEW_TIME 0.005

void knurl_heat_init(knurl_heat *heat, const knurl_hip_facts *facts) {
    const double ratio = facts->max_force / facts->continuous_force; /* 0 where there is no limit */
    heat->theta = 0.0;
    heat->share = -expm1(-1.0 / (facts->rate * facts->heat_time)); /* exact for a force that is held for the tick */
    heat->per_force = 1.0 / (facts->continuous_force * facts->continuous_force);
    heat->continuous = facts->continuous_force;
    heat->excess = ratio > 1.0 ? ratio * ratio - 1.0 : 0.0;
    heat->max_force = facts->max_force;
}

double knurl_heat_limit(const knurl_heat *heat) {
    if (heat->theta <= WARM || heat->excess == 0.0) {
        return heat->max_force;
    }
    const double left = (1.0 - heat->theta) / (1.0 - WARM);
    return heat->continuous * sqrt(1.0 + heat->excess * left);
}

void knurl_heat_add(knurl_heat *heat, double force2) {
    heat->theta += heat->share * (force2 * heat->per_force - heat->theta);
    heat->theta = heat->theta < 1.0 || heat->excess == 0.0 ? heat->theta : 1.0;
}

double knurl_bounds_stability(const knurl_bounds *bounds, double damping) {
    return (bounds->friction + damping * bounds->scale) / bounds->lag;
}

double knurl_bounds_stiffness(const knurl_bounds *bounds, double damping) {
    const double stable = knurl_bounds_stability(bounds, damping);
    return stable < bounds->max_stiffness ? stable : bounds->max_stiffness;
}

double knurl_swing(int32_t method) {
    switch (method) {
    case KNURL_S1:
        return 2.0; /* +A, -A */
    case KNURL_LOCKED:
        return 2.41421356237309505; /* +A of an even event, -sqrt(2) A at 3 ticks */
    default:
        return 2.87444560869411535; /* the mix: (2 + 3 sqrt(1/2))/sqrt(13) and -(2 + 3 sqrt(2))/sqrt(13) */
    }
}

double knurl_bounds_amplitude(const knurl_bounds *bounds, double stiffness, int32_t method) {
    const double peak = bounds->max_force / (stiffness * knurl_swing(method));
    const double steady = bounds->continuous_force / stiffness;
    return peak < steady ? peak : steady;
}

void knurl_guard_init(knurl_guard *guard, const knurl_hip_desc *desc, const knurl_hip_facts *facts, double scale) {
    const double period = 1.0 / facts->rate;
    knurl_hip_facts cool = *facts;
    memset(guard, 0, sizeof *guard);
    if (desc->unguarded & KNURL_UNGUARDED_HEAT) {
        cool.continuous_force = HUGE_VAL;
    }
    knurl_heat_init(&guard->heat, &cool);
    const double slew = desc->slew_rate > 0.0 ? desc->slew_rate : facts->max_force / SLEW_TIME;
    guard->entry = desc->unguarded & KNURL_UNGUARDED_ENTRY ? HUGE_VAL : KNURL_ENTRY_SPEED * scale * period;
    guard->slew = desc->unguarded & KNURL_UNGUARDED_SLEW ? HUGE_VAL : slew * period;
    guard->clamp = (int32_t)desc->clamp;
    guard->bounds.scale = scale;
    guard->bounds.friction = facts->viscous + KNURL_LIGHTEST_HAND;
    guard->bounds.lag = (0.5 + facts->delay) * period;
    guard->bounds.max_stiffness = facts->max_stiffness;
    guard->bounds.max_force = facts->max_force;
    guard->bounds.continuous_force = facts->continuous_force;
    guard->bounds.quantum = facts->resolution * scale;
}

double knurl_guard_enter(const knurl_guard *guard, knurl_guard_contact *contact, double z, uint32_t *flags) {
    const double most = contact->felt + guard->entry;
    if (-z > most) {
        *flags |= KNURL_TICK_ENTRY;
        z = -most;
    }
    contact->felt = z < 0.0 ? -z : 0.0;
    return z;
}

void knurl_guard_clamp(const knurl_guard *guard, const knurl_material_desc *material, double *stiffness,
                       double *amplitude) {
    *stiffness = material->stiffness;
    *amplitude = material->amplitude;
    if (guard->clamp) {
        const double most = knurl_bounds_stiffness(&guard->bounds, material->damping) / guard->bounds.scale;
        *stiffness = *stiffness < most ? *stiffness : most;
        const double highest = knurl_bounds_amplitude(&guard->bounds, *stiffness, material->method);
        *amplitude = *amplitude < highest ? *amplitude : highest;
    }
}

void knurl_guard_leave(knurl_guard_contact *contact) {
    contact->felt = contact->height = 0.0;
}

void knurl_guard_step(knurl_guard *guard, knurl_guard_contact *contact, double stiffness, double height) {
    guard->step += stiffness * fabs(height - contact->height);
    contact->height = height;
}

/* What falls is free: measured is from the nearest point on the way from no force to the latest one. */
static void limit_slew(const knurl_guard *guard, double force[3], uint32_t *flags) {
    const double latest2 = vec3_dot(guard->force, guard->force);
    const double along = vec3_dot(force, guard->force);
    const double kept = along <= 0.0 ? 0.0 : along < latest2 ? along / latest2 : 1.0;
    const double most = guard->slew + guard->step;
    double from[3];
    double change[3];
    vec3_scale(kept, guard->force, from);
    vec3_sub(force, from, change);
    const double change2 = vec3_dot(change, change);
    if (change2 > most * most) {
        vec3_madd(from, most / sqrt(change2), change, force);
        *flags |= KNURL_TICK_SLEW;
    }
}

double knurl_guard_force(knurl_guard *guard, double force[3], uint32_t *flags) {
    limit_slew(guard, force, flags);
    double length = vec3_length(force);
    const double most = knurl_heat_limit(&guard->heat);
    if (length > most) {
        vec3_scale(most / length, force, force);
        *flags |= most < guard->heat.max_force ? KNURL_TICK_HEAT : KNURL_TICK_FORCE_LIMIT;
        length = vec3_length(force);
    }
    if (isfinite(length)) {
        vec3_copy(force, guard->force);
        knurl_heat_add(&guard->heat, length * length);
    }
    guard->step = 0.0;
    return length;
}

void knurl_guard_let_go(knurl_guard *guard) {
    guard->force[0] = guard->force[1] = guard->force[2] = 0.0;
    guard->step = guard->left = 0.0;
    knurl_heat_add(&guard->heat, 0.0);
}

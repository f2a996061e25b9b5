/* The protections. SPDX-License-Identifier: MIT */
#include "scene/guard.h"

#include <string.h>

/* theta from which on the force limit comes down. Any value keeps theta below 1; this one leaves the full force for 90
 * % of the way and takes it back over the last tenth, in which a hand can let go of what it presses. */
#define WARM 0.9

/* The passivity controller's, tuned in the stability laboratory: over its maps, within the limits that the devices'
 * makers promise, what was calm came to at most 1.55 mJ in an account that leaks away in a quarter of a second, and
 * what ran away to at least 1.7 mJ (tests/stability/test_protections.c). With 0.1 s the two overlap. */
#define LEAK_TIME 0.25   /* s */
#define BUDGET    1.6e-3 /* J */

/* What an alarm does: how much of the passive stiffness it leaves, how fast (s; a millisecond would be felt as a blow),
 * and how long a HIP must be off all walls for them to be hard again (s): a hand that bounces is not off. */
#define SOFT_SHARE     0.8
#define SOFTENING_TIME 0.02
#define OFF_TIME       0.5

/* m/s: what of a tick's way counts at most. A position that jumps is no vibration. */
#define SPEED_MOST 0.5

/* N s/m: the hand that the controller counts on: it hardly holds. Less than KNURL_LIGHTEST_HAND: a check at load must
 * not cry wolf, and a controller must not overlook one. */
#define LOOSE_HAND 0.5

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

static void start_account(knurl_passivity *p, const knurl_hip_desc *desc, const knurl_hip_facts *facts, double scale) {
    p->on = !(desc->unguarded & KNURL_UNGUARDED_PASSIVITY);
    p->kept = exp(-1.0 / (facts->rate * LEAK_TIME));
    p->budget = BUDGET * scale; /* energies count scene metres */
    p->lag = 0.5 + facts->delay;
    p->loss = (facts->viscous + LOOSE_HAND) / scale * facts->rate;
    p->dry = facts->coulomb;
    p->longest = SPEED_MOST * scale / facts->rate;
    p->softening = 1.0 / (1.0 + SOFTENING_TIME * facts->rate);
    p->off_most = OFF_TIME * facts->rate;
}

void knurl_guard_init(knurl_guard *guard, const knurl_hip_desc *desc, const knurl_hip_facts *facts, double scale) {
    const double period = 1.0 / facts->rate;
    knurl_hip_facts cool = *facts;
    memset(guard, 0, sizeof *guard);
    if (desc->unguarded & KNURL_UNGUARDED_HEAT) {
        cool.continuous_force = HUGE_VAL;
    }
    knurl_heat_init(&guard->heat, &cool);
    start_account(&guard->passivity, desc, facts, scale);
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

/* Lets the account leak, raises the alarm, and ends it. */
void knurl_guard_keep_account(knurl_passivity *p) {
    if (!p->alarmed && p->given > p->budget + p->asked) {
        p->alarmed = 1;
        p->off = 0.0;
    }
    p->given *= p->kept;
    p->asked *= p->kept;
    if (p->alarmed) {
        p->soft += p->softening * (1.0 - p->soft);
        p->off += 1.0;
        if (p->off > p->off_most) {
            p->given = p->asked = p->soft = 0.0;
            p->alarmed = 0;
        }
    }
    if (!p->alarmed && p->given + p->asked < 1e-6 * p->budget) { /* long before it is denormal */
        p->given = p->asked = 0.0;
        p->busy = 0;
    }
}

void knurl_guard_limit_wall(const knurl_bounds *bounds, const knurl_material_desc *material, knurl_guard_wall *wall) {
    const double most = knurl_bounds_stiffness(bounds, material->damping) / bounds->scale;
    wall->stiffness = wall->stiffness < most ? wall->stiffness : most;
    const double highest = knurl_bounds_amplitude(bounds, wall->stiffness, material->method);
    wall->amplitude = wall->amplitude < highest ? wall->amplitude : highest;
}

/* A spring that is sampled and held lags `lag` ticks behind: over a tick's way it gives K lag way^2 more than a spring
 * would, and friction takes (b/T) way^2 and its dry part's share of the way. Where the first is less nothing runs away
 * (Colgate and Schenkel 1997, as a balance of energy). A wall's own damping comes late too: it may not help. */
static void account(knurl_passivity *p, const knurl_guard_contact *contact, const knurl_guard_wall *wall,
                    const double moved[3]) {
    double way = fabs(wall->z - contact->z);
    if (!contact->pushed || way == 0.0) {
        return;
    }
    way = way < p->longest ? way : p->longest;
    const double dry = p->dry > 0.0 ? p->dry / fmax(vec3_length(moved), way) : 0.0;
    const double given = p->given + (wall->stiffness * p->lag - p->loss - dry) * way * way;
    p->given = given > 0.0 ? given : 0.0;
    p->busy |= p->given > 0.0;
}

void knurl_guard_watch(knurl_passivity *p, const knurl_guard_contact *contact, knurl_guard_wall *wall,
                       const double way[3], uint32_t *flags) {
    account(p, contact, wall, way);
    if (p->alarmed && wall->felt < 0.0) {
        const double most = SOFT_SHARE * p->loss / p->lag;
        p->off = 0.0;
        wall->damping *= 1.0 - p->soft;
        if (wall->stiffness > most) {
            wall->stiffness +=
                p->soft *
                (most -
                 wall->stiffness); /* and its texture weaker: on a soft wall its full steps would throw the hand */
        }
        *flags |= KNURL_TICK_PASSIVITY;
    }
}

void knurl_guard_ask(knurl_passivity *p, const knurl_guard_contact *contact, const knurl_guard_wall *wall,
                     double height) {
    const double before = contact->height > wall->z ? contact->height - wall->z : 0.0;
    const double after = height > wall->z ? height - wall->z : 0.0;
    const double asked = p->asked + 0.5 * wall->stiffness * (after * after - before * before);
    p->asked = asked > 0.0 ? asked : 0.0;
}

/* What falls is free: measured is from the nearest point on the way from no force to the latest one. */
static void limit_slew(const knurl_guard *guard, double force[3], uint32_t *flags) {
    const double most = guard->slew + guard->step;
    double from[3];
    double change[3];
    vec3_sub(force, guard->force, change);
    if (vec3_dot(change, change) <= most * most) {
        return;
    }
    const double latest2 = vec3_dot(guard->force, guard->force);
    const double along = vec3_dot(force, guard->force);
    vec3_scale(along <= 0.0 ? 0.0 : along < latest2 ? along / latest2 : 1.0, guard->force, from);
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

/* The protections. SPDX-License-Identifier: MIT */
#include "scene/guard.h"

#include <string.h>

/* theta from which on the force limit comes down. Any value keeps theta below 1; this one leaves the full force for 90
 * % of the way and takes it back over the last tenth, in which a hand can let go of what it presses. */
#define WARM 0.9

/* The passivity controller's. What a runaway is: the HIP swings in and out of a wall, faster than hands do, time after
 * time as far as before, and no texture moves it so. An account of the energy that a sampled wall gives cannot tell:
 * near the limit what it gives is what friction and hand take, whose parts nobody knows. Tuned in the stability
 * laboratory on flat walls and gratings within the limits of the presets touch and falcon (7064 cells: the study's maps
 * and a finer grid, 127 of them runaways, of 12 to 25 Hz). On flat walls a row came to 24 mm^2 in all 37 that ran away
 * and in none of 861 that rested; on gratings in 83 of 90, and in 32 of 6013 that were no runaways by the laboratory's
 * millimetre, of which 30 shook by more than half of it. */
#define TURN    0.2e-3 /* m: what the depth comes back by is a turn: four quanta */
#define LEAST   0.7e-3 /* m: a smaller swing ends a row; runaways swing by 0.84 mm and more, arrivals soon by less */
#define PERIOD  0.12   /* s: a slower swing ends a row; hands tap and shake on purpose at up to 8 Hz */
#define FORGETS 0.985  /* of the largest swing, a swing: what was large on arrival and keeps dying has no row */
#define AGAIN   0.9    /* of the largest: a quantum of 0.06 mm is a tenth of the smallest swing */
#define ROW     4      /* swings: as many may be the arrival of a hand */
#define ENOUGH  24e-6  /* m^2: 4 swings of 2.5 mm, 17 of 1.2 mm */

/* A texture has not made a swing of which it moves no more than this share; nor one in which it crosses 0 more often
 * than it would if the HIP bounced off every other ridge: twice, or four times in and out again. */
#define TEXTURE_SHARE 0.25
#define TEXTURE_SLOW  2

/* What an alarm does: how much of the passive stiffness it leaves, how fast (s; a millisecond would be felt as a blow),
 * and how long a HIP must be off all walls for them to be hard again (s): a hand that bounces is not off. */
#define SOFT_SHARE     0.8
#define SOFTENING_TIME 0.02
#define OFF_TIME       0.5

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

/* The closed form of as many knurl_heat_add(). */
void knurl_heat_hold(knurl_heat *heat, double force2, double ticks) {
    const double to = force2 * heat->per_force;
    heat->theta = to + (heat->theta - to) * exp(ticks * log1p(-heat->share));
    heat->theta = heat->theta < 1.0 || heat->excess == 0.0 ? heat->theta : 1.0;
}

double knurl_heat_get(const knurl_heat *heat) {
    return heat->theta > 0.0 ? heat->theta * heat->continuous * heat->continuous : 0.0; /* endless: none is kept */
}

void knurl_heat_set(knurl_heat *heat, double square) {
    const double theta = square * heat->per_force;
    heat->theta = theta < 1.0 || heat->excess == 0.0 ? theta : 1.0;
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

/* Below `safe` nothing runs away: b and the hand take what a spring gives that lags behind (Colgate and Schenkel
 * 1997). Dry friction helps a hand that is still, and hardly one that slides: it is not counted on. */
static void start_watch(knurl_passivity *p, const knurl_hip_desc *desc, const knurl_hip_facts *facts, double scale) {
    p->safe = desc->unguarded & KNURL_UNGUARDED_PASSIVITY
                  ? HUGE_VAL
                  : (facts->viscous + LOOSE_HAND) * facts->rate / ((0.5 + facts->delay) * scale);
    p->unit = scale;
    p->longest = PERIOD * facts->rate;
    p->softening = 1.0 / (1.0 + SOFTENING_TIME * facts->rate);
    p->off_most = OFF_TIME * facts->rate;
}

void knurl_guard_init(knurl_guard *guard, const knurl_hip_desc *desc, const knurl_hip_facts *facts, double scale) {
    const double period = 1.0 / facts->rate;
    const double heat = knurl_heat_get(&guard->heat);
    memset(guard, 0, sizeof *guard);
    knurl_heat_init(&guard->heat, facts);
    if (desc->unguarded & KNURL_UNGUARDED_HEAT) {
        guard->heat.excess = 0.0;
    }
    knurl_heat_set(&guard->heat, heat);
    start_watch(&guard->passivity, desc, facts, scale);
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

static void end_row(knurl_passivity *p) {
    p->largest = p->squares = 0.0;
    p->row = 0;
}

/* The depth has turned: a swing is over. Friction's spring, along the wall and as stiff, is not watched: it slips where
 * it would be longer than friction times the depth, which bounds its swing; an alarm softens it with its wall. */
static void turn(knurl_passivity *p) {
    const double swing = fabs(p->farthest - p->extreme);
    const int slow = p->crossings <= TEXTURE_SLOW && p->crossings + p->crossed <= 2 * TEXTURE_SLOW;
    const int asked = slow && p->moved > TEXTURE_SHARE * swing;
    if (asked || swing < LEAST * p->unit || p->ticks + p->before > p->longest) {
        end_row(p);
    } else {
        const double largest = FORGETS * p->largest;
        p->largest = swing > largest ? swing : largest;
        if (swing < AGAIN * p->largest) { /* begins anew, but for what may have been chance */
            p->squares *= 0.5;
            p->row = 0;
        }
        p->squares += swing * swing;
        p->alarmed = ++p->row >= ROW && p->squares > ENOUGH * p->unit * p->unit;
        p->off = 0.0;
    }
    p->extreme = p->farthest;
    p->farthest = p->depth;
    p->outwards = !p->outwards;
    p->before = p->ticks;
    p->crossed = p->crossings;
    p->ticks = p->crossings = 0;
    p->moved = 0.0;
}

/* From a tick to the next one without an alarm. */
static void follow_depth(knurl_passivity *p) {
    const double beyond = p->outwards ? p->farthest - p->depth : p->depth - p->farthest;
    p->ticks++;
    if (beyond > 0.0) {
        p->farthest = p->depth;
    } else if (-beyond > TURN * p->unit) {
        turn(p);
    } else if (p->ticks > p->longest) { /* rests, or is off */
        end_row(p);
        p->ticks = (int32_t)p->longest;
        p->crossings = 0;
        p->moved = 0.0;
        p->busy = p->depth > 0.0;
    }
}

void knurl_guard_follow(knurl_passivity *p) {
    if (p->alarmed) {
        p->crossings = 0;
        p->soft += p->softening * (1.0 - p->soft);
        p->off += 1.0;
        if (p->off > p->off_most) {
            end_row(p);
            p->soft = 0.0;
            p->alarmed = 0;
        }
    } else {
        follow_depth(p);
    }
    p->depth = 0.0;
}

void knurl_guard_limit_wall(const knurl_bounds *bounds, knurl_guard_wall *wall) {
    const knurl_material_desc *material = wall->material;
    const double most = knurl_bounds_stiffness(bounds, material->damping) / bounds->scale;
    wall->stiffness = wall->stiffness < most ? wall->stiffness : most;
    const double highest = knurl_bounds_amplitude(bounds, wall->stiffness, material->method);
    wall->amplitude = wall->amplitude < highest ? wall->amplitude : highest;
}

void knurl_guard_watch(knurl_passivity *p, knurl_guard_wall *wall, uint32_t *flags) {
    const double depth = -wall->felt;
    p->depth = depth > p->depth ? depth : p->depth;
    p->busy = 1;
    if (p->alarmed && depth > 0.0) {
        const double most = SOFT_SHARE * p->safe;
        p->off = 0.0;
        wall->damping *= 1.0 - p->soft;
        if (wall->stiffness > most) { /* and its texture weaker: its full steps would throw a hand off a soft wall */
            wall->stiffness += p->soft * (most - wall->stiffness);
        }
        *flags |= KNURL_TICK_PASSIVITY;
    }
}

/* What falls is free: measured is from the nearest point on the way from no force to the latest one. */
static void limit_slew(const knurl_guard *guard, double steps, double force[3], uint32_t *flags) {
    const double most = guard->slew + steps;
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

/* N: the steps of this tick's textures, which are let through. What they move of a hand is no shaking. */
static double add_textures(knurl_guard *guard, const knurl_guard_wall *walls, uint32_t count) {
    double steps = 0.0;
    for (uint32_t i = 0; i < count; i++) {
        const knurl_guard_wall *wall = &walls[i];
        const double step = fabs(wall->height - wall->contact->height);
        steps += wall->stiffness * step;
        if (wall->watched) {
            guard->passivity.moved += step;
            guard->passivity.crossings += (wall->height > 0.0) != (wall->contact->height > 0.0);
        }
        wall->contact->height = wall->height;
    }
    return steps;
}

/* Of a force that the motors could play: ramps go from and to that. */
static void attenuate(const knurl_guard *guard, double force[3]) {
    const double length = vec3_length(force);
    const double most = knurl_heat_limit(&guard->heat);
    vec3_scale(length > most ? guard->gain * (most / length) : guard->gain, force, force);
}

double knurl_guard_after(knurl_guard *guard, const knurl_guard_wall *walls, uint32_t count, double force[3],
                         uint32_t *flags) {
    double steps = add_textures(guard, walls, count);
    if (guard->gain < 1.0) {
        attenuate(guard, force);
        steps *= guard->gain;
    }
    limit_slew(guard, steps, force, flags);
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

void knurl_guard_sent(knurl_guard *guard, const double force[3]) {
    vec3_copy(force, guard->force);
    knurl_heat_add(&guard->heat, vec3_dot(force, force));
}

void knurl_guard_reset(knurl_guard *guard) {
    guard->force[0] = guard->force[1] = guard->force[2] = 0.0;
    knurl_heat_add(&guard->heat, 0.0);
}

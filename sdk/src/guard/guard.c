/* The protections, and the closed-form limits of a device. SPDX-License-Identifier: MIT */
#include "guard/guard.h"

#include "grating/method.h"

#include <string.h>

void knurl_guard_init(knurl_guard *guard, const knurl_hip_desc *desc, const knurl_hip_facts *facts) {
    memset(guard, 0, sizeof *guard);
    knurl_passivity_init(&guard->passivity, facts);
    guard->clamp = (int32_t)desc->clamp;
}

/* Effects pull from both sides, so a swing does not leave them as it leaves a wall, and they are limited before they
 * shake. Tuned in the stability laboratory (samples/study/README.md): a device without dry friction in a loose hand
 * starts to shake at `safe`, and a Touch, raw, at a damping of 33 N s/m, or 8 with four ticks of delay. */
#define EFFECT_STIFFNESS 0.8  /* of the `safe` stiffness */
#define EFFECT_DAMPING   20.0 /* N s/m, at the device */
#define EFFECT_TIME      0.03 /* s: damping over `safe` */

static void limit_effects(knurl_guard *guard, const knurl_hip_facts *facts, double scale) {
    const double safe = guard->passivity.safe;
    const int watches = safe < HUGE_VAL;
    guard->effect_stiffness = watches ? knurl_min(EFFECT_STIFFNESS * safe, facts->max_stiffness / scale) : HUGE_VAL;
    guard->effect_damping = watches ? knurl_min(EFFECT_TIME * safe, EFFECT_DAMPING / scale) : HUGE_VAL;
}

void knurl_guard_set_scale(knurl_guard *guard, const knurl_hip_desc *desc, const knurl_hip_facts *facts, double scale) {
    const double period = 1.0 / facts->rate;
    guard->entry = desc->protections & KNURL_PROTECT_ENTRY ? KNURL_ENTRY_SPEED_MAX * scale * period : HUGE_VAL;
    knurl_passivity_set_scale(&guard->passivity, (desc->protections & KNURL_PROTECT_PASSIVITY) != 0, facts, scale);
    limit_effects(guard, facts, scale);
    knurl_bounds_init(&guard->bounds, facts, scale);
}

void knurl_guard_limit_wall(const knurl_bounds *bounds, knurl_wall *wall) {
    const knurl_material_desc *material = wall->material;
    const double most = knurl_bounds_stiffness(bounds, material->damping) / bounds->scale;
    wall->stiffness = wall->stiffness < most ? wall->stiffness : most;
    const double highest = knurl_bounds_amplitude(bounds, wall->stiffness, material->method);
    wall->amplitude = wall->amplitude < highest ? wall->amplitude : highest;
}

void knurl_bounds_init(knurl_bounds *bounds, const knurl_hip_facts *facts, double scale) {
    bounds->scale = scale;
    bounds->friction = facts->viscous + KNURL_LIGHTEST_HAND;
    bounds->lag = (0.5 + facts->delay) * (1.0 / facts->rate);
    bounds->max_stiffness = facts->max_stiffness;
    bounds->max_force = facts->max_force;
    bounds->continuous_force = facts->continuous_force;
    bounds->quantum = facts->resolution * scale;
}

double knurl_bounds_stability(const knurl_bounds *bounds, double damping) {
    return (bounds->friction + damping * bounds->scale) / bounds->lag;
}

double knurl_bounds_stiffness(const knurl_bounds *bounds, double damping) {
    const double stable = knurl_bounds_stability(bounds, damping);
    return stable < bounds->max_stiffness ? stable : bounds->max_stiffness;
}

double knurl_bounds_amplitude(const knurl_bounds *bounds, double stiffness, int32_t method) {
    const double peak = bounds->max_force / (stiffness * knurl_methods[method].swing);
    const double steady = bounds->continuous_force / stiffness;
    return peak < steady ? peak : steady;
}

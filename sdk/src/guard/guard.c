/* The protections. SPDX-License-Identifier: MIT */
#include "guard/guard.h"

#include <string.h>

void knurl_guard_init(knurl_guard *guard, const knurl_hip_desc *desc, const knurl_hip_facts *facts) {
    memset(guard, 0, sizeof *guard);
    knurl_passivity_init(&guard->passivity, facts);
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

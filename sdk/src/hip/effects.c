/* The forces of effects. SPDX-License-Identifier: MIT */
#include "hip/effects.h"

#include "base/base.h"
#include "base/number.h"
#include "base/vec3.h"

#include <stdio.h>

#define TWO_PI 6.283185307179586

/* The part of a vector that an effect acts on. */
enum { ALL, ALONG, ACROSS };

/* A row for each KNURL_EFFECT_. */
static const struct {
    int32_t part;
    int32_t has_axis;
    double spring, damper; /* 1: has one */
} kinds[] = {
    [KNURL_EFFECT_SPRING] = {ALL, 0, 1.0, 1.0},  [KNURL_EFFECT_DETENT] = {ALONG, 1, 1.0, 1.0},
    [KNURL_EFFECT_DAMPER] = {ALL, 0, 0.0, 1.0},  [KNURL_EFFECT_LINE] = {ACROSS, 1, 1.0, 1.0},
    [KNURL_EFFECT_PLANE] = {ALONG, 1, 1.0, 1.0}, [KNURL_EFFECT_FORCE] = {ALONG, 1, 0.0, 0.0},
};

#define LAST_KIND ((int32_t)(sizeof kinds / sizeof *kinds) - 1)

static knurl_result check_kind(const char *name, int32_t kind) {
    if (kind < KNURL_EFFECT_SPRING || kind > LAST_KIND) {
        (void)knurl_fail(KNURL_ERROR_ARGUMENT, "%skind: expected %d to %d (KNURL_EFFECT_), found %d", name,
                         KNURL_EFFECT_SPRING, (int)LAST_KIND, (int)kind);
        return KNURL_ERROR_ARGUMENT; /* a constant, so that clang-tidy sees that `kind` is an index of the table */
    }
    return KNURL_OK;
}

knurl_result knurl_effect_prepare(int32_t kind, knurl_effect *effect) {
    if (KNURL_IS_NULL(effect) || check_kind("", kind)) {
        return KNURL_ERROR_ARGUMENT;
    }
    const knurl_effect made = {
        .kind = kind, .axis = {0.0, 1.0, 0.0}, .stiffness = 200.0, .damping = 1.0, .spacing = 0.01, .max_force = 2.0};
    *effect = made;
    return KNURL_OK;
}

static const knurl_field fields[] = {
    {"stiffness", offsetof(knurl_effect, stiffness), {KNURL_RANGE_STIFFNESS, KNURL_OR_ZERO}},
    {"damping", offsetof(knurl_effect, damping), {KNURL_RANGE_VISCOUS, 0}},
    {"spacing", offsetof(knurl_effect, spacing), {1e-6, KNURL_COORDINATE_MAX, "m", 0}},
    {"max_force", offsetof(knurl_effect, max_force), {KNURL_RANGE_FORCE, 0}},
};

static knurl_result check(unsigned index, const knurl_effect *e) {
    char name[16], member[32];
    (void)snprintf(member, sizeof member, "effects[%u].", index);
    knurl_result result = check_kind(member, e->kind);
    (void)snprintf(member, sizeof member, "effects[%u].anchor", index);
    result = result ? result : knurl_check_coordinates(member, "m", e->anchor);
    (void)snprintf(member, sizeof member, "effects[%u].axis", index);
    result = result ? result : knurl_check_coordinates(member, "", e->axis);
    (void)snprintf(name, sizeof name, "effects[%u]", index);
    result = result ? result : knurl_fields_check(name, fields, sizeof fields / sizeof *fields, e);
    if (!result && kinds[e->kind].has_axis && !(vec3_length(e->axis) > 0.0)) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "%s: expected a vector with a length, found one of length 0", member);
    }
    if (!result && (e->reserved_bits | e->reserved[0] | e->reserved[1] | e->reserved[2] | e->reserved[3])) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "%s.reserved: expected zeros, found another number", name);
    }
    return result;
}

knurl_result knurl_effects_check(const knurl_effect *effects, uint32_t count) {
    if (count > KNURL_EFFECTS_MAX) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "count: expected 0 to %d effects, found %u", KNURL_EFFECTS_MAX,
                          (unsigned)count);
    }
    if (count > 0 && KNURL_IS_NULL(effects)) {
        return KNURL_ERROR_ARGUMENT;
    }
    for (uint32_t i = 0; i < count; i++) {
        const knurl_result result = check(i, &effects[i]);
        if (result) {
            return result;
        }
    }
    return KNURL_OK;
}

/* Keeps the part of a vector that an effect acts on. */
static void take_part(const knurl_effect *e, double vector[3]) {
    const double along = vec3_dot(vector, e->axis);
    if (kinds[e->kind].part == ALONG) {
        vec3_scale(along, e->axis, vector);
    } else if (kinds[e->kind].part == ACROSS) {
        vec3_madd(vector, -along, e->axis, vector);
    }
}

/* Sets the bounds of the sums: by Gershgorin, no direction has more than the largest sum of a row. */
static void set_bounds(knurl_effects *effects) {
    for (int i = 0; i < 3; i++) {
        double stiffness[3] = {0.0, 0.0, 0.0};
        double damping[3] = {0.0, 0.0, 0.0};
        for (uint64_t k = 0; k < effects->count; k++) {
            const knurl_effect *e = &effects->list[k].effect;
            double unit[3] = {i == 0, i == 1, i == 2};
            take_part(e, unit);
            vec3_madd(stiffness, kinds[e->kind].spring * e->stiffness, unit, stiffness);
            vec3_madd(damping, kinds[e->kind].damper * e->damping, unit, damping);
        }
        effects->stiffness = knurl_max(effects->stiffness, vec3_sum(stiffness));
        effects->damping = knurl_max(effects->damping, vec3_sum(damping));
    }
}

/* m: the way that an anchor has still to go at `time`. */
static void way_left(const knurl_placed_effect *placed, double time, double way[3]) {
    vec3_scale(knurl_max(placed->end_time - time, 0.0), placed->velocity, way);
}

void knurl_effects_place(knurl_effects *made, const knurl_effect *effects, uint32_t count, const knurl_effects *before,
                         double now, double period, double seconds) {
    made->count = count;
    for (uint32_t i = 0; i < count; i++) {
        knurl_placed_effect *placed = &made->list[i];
        placed->effect = effects[i];
        if (kinds[effects[i].kind].has_axis) {
            vec3_normalise(placed->effect.axis);
            vec3_normalise(placed->effect.axis); /* the square of a tiny one lost digits */
        }
        if (before && i < before->count && before->list[i].effect.kind == effects[i].kind && seconds > period) {
            const knurl_placed_effect *old = &before->list[i];
            double way[3];
            way_left(old, now, way);
            vec3_madd(way, 1.0, placed->effect.anchor, way);
            vec3_sub(way, old->effect.anchor, way);
            vec3_scale(1.0 / seconds, way, placed->velocity);
            placed->end_time = now + seconds;
        }
    }
    set_bounds(made);
}

/* m: by which a detent's spring is stretched at x. */
static double notch(const knurl_effect *e, double x) {
    return e->spacing / TWO_PI * sin(x * (TWO_PI / e->spacing));
}

/* Adds the force of one effect. x: from its anchor to the HIP; v: relative to it. */
static void add_force(const knurl_effect *e, const knurl_effect_shares *shares, double x[3], double v[3],
                      double sum[3]) {
    double force[3];
    if (e->kind == KNURL_EFFECT_FORCE) {
        vec3_madd(sum, e->max_force, e->axis, sum);
        return;
    }
    take_part(e, x);
    take_part(e, v);
    if (e->kind == KNURL_EFFECT_DETENT) {
        vec3_scale(notch(e, vec3_dot(x, e->axis)), e->axis, x);
    }
    vec3_scale(-shares->stiffness * kinds[e->kind].spring * e->stiffness, x, force);
    vec3_madd(force, -shares->damping * e->damping, v, force);
    const double length = vec3_length(force);
    vec3_madd(sum, length > e->max_force ? e->max_force / length : 1.0, force, sum);
}

void knurl_effects_force(const knurl_effects *effects, const knurl_effect_shares *shares, const double hip[3],
                         const double velocity[3], double time, double force[3]) {
    force[0] = force[1] = force[2] = 0.0;
    for (uint64_t i = 0; i < effects->count; i++) {
        const knurl_placed_effect *placed = &effects->list[i];
        double x[3], v[3];
        way_left(placed, time, x);
        vec3_madd(hip, 1.0, x, x);
        vec3_sub(x, placed->effect.anchor, x);
        vec3_madd(velocity, time < placed->end_time ? -1.0 : 0.0, placed->velocity, v);
        add_force(&placed->effect, shares, x, v, force);
    }
}

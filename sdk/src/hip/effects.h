/* A HIP's effects: immutable once a tick can see them. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_EFFECTS_H
#define KNURL_SRC_EFFECTS_H

#include "surface/epoch.h"

#include <knurl/effect.h>

/* An effect whose anchor moves to effect.anchor until end_time. */
typedef struct knurl_placed_effect {
    knurl_effect effect; /* its axis has length 1 */
    double velocity[3];  /* m/s, of the anchor */
    double end_time;     /* s */
} knurl_placed_effect;

typedef struct knurl_effects {
    knurl_retired retired; /* first */
    uint64_t count;
    double stiffness, damping; /* N/m, N s/m: upper bounds of the sums in any direction */
    knurl_placed_effect list[KNURL_EFFECTS_MAX];
} knurl_effects;

/* The shares of their stiffness and damping that are played, 0 to 1. */
typedef struct knurl_effect_shares {
    double stiffness, damping;
} knurl_effect_shares;

/* Errors: KNURL_ERROR_ARGUMENT (effect, field, expected, found). */
knurl_result knurl_effects_check(const knurl_effect *effects, uint32_t count);

/* Fills in `made` from checked effects. before: those so far, or null. now: s; period: s, of a tick; seconds: from now
 * until the anchors are in place. */
void knurl_effects_place(knurl_effects *made, const knurl_effect *effects, uint32_t count, const knurl_effects *before,
                         double now, double period, double seconds);

/* The sum of all forces, N, scene. hip: m; velocity: m/s; time: s. */
void knurl_effects_force(const knurl_effects *effects, const knurl_effect_shares *shares, const double hip[3],
                         const double velocity[3], double time, double force[3]) KNURL_NONBLOCKING;

#endif

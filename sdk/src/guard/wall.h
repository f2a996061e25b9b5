/* One contact's wall in a tick: at first as its material is, then as the protections limit it.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_WALL_H
#define KNURL_SRC_WALL_H

#include <knurl/hip.h>

/* Kept from tick to tick, per contact. */
typedef struct knurl_wall_state {
    double depth;  /* m: at the last tick, as limited by the entry ramp; 0 without contact */
    double height; /* m: H at the last tick */
} knurl_wall_state;

/* At one tick. Scene units. */
typedef struct knurl_wall {
    const knurl_material_desc *material;
    knurl_wall_state *state;
    double z;         /* m: signed distance, negative inside; the entry ramp limits its depth */
    double stiffness; /* N/m */
    double amplitude; /* m */
    double damping;   /* N s/m */
    double height;    /* m: H, set by the force law */
} knurl_wall;

/* Sets a wall from its material and amplitude (m) at z (m, scene), before the forces. */
static inline void knurl_wall_init(knurl_wall *wall, const knurl_material_desc *material, double amplitude, double z,
                                   knurl_wall_state *state) {
    wall->material = material;
    wall->state = state;
    wall->z = z;
    wall->stiffness = material->stiffness;
    wall->amplitude = amplitude;
    wall->damping = material->damping;
}

/* Begins a contact. depth: m, the ramped depth on the surface that the HIP comes from, so that the ramp continues from
 * it; else 0. */
static inline void knurl_wall_begin(knurl_wall_state *state, double depth) {
    state->depth = state->depth < depth ? depth : state->depth;
}

/* Ends a contact, if there is one. */
static inline void knurl_wall_end(knurl_wall_state *state) {
    state->depth = state->height = 0.0;
}

#endif

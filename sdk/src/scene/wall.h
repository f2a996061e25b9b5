/* A wall on its way through a tick: as asked for, then as the protections have it felt. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_WALL_H
#define KNURL_SRC_WALL_H

#include <knurl/scene.h>

/* Of one contact. */
typedef struct knurl_wall_state {
    double depth;  /* m: that the ramp has come to at the latest tick, 0 without contact */
    double height; /* m: H at the latest tick */
} knurl_wall_state;

/* At one tick. Scene units. */
typedef struct knurl_wall {
    const knurl_material_desc *material;
    knurl_wall_state *contact;
    double felt;      /* m: z; then as it is felt */
    double stiffness; /* N/m, as felt */
    double amplitude; /* m, as felt */
    double damping;   /* N s/m */
    double height;    /* m: H, by the grating: known after the force */
} knurl_wall;

/* A material's wall at z (m, scene): what the forces begin with. */
static inline void knurl_wall_init(knurl_wall *wall, const knurl_material_desc *material, double z,
                                   knurl_wall_state *contact) {
    wall->material = material;
    wall->contact = contact;
    wall->felt = z;
    wall->stiffness = material->stiffness;
    wall->amplitude = material->amplitude;
    wall->damping = material->damping;
}

/* A contact begins. felt: m, the depth that was felt on the surface that it is handed over from; else 0. */
static inline void knurl_wall_begin(knurl_wall_state *state, double felt) {
    state->depth = state->depth < felt ? felt : state->depth;
}

/* There is no contact (any more). */
static inline void knurl_wall_end(knurl_wall_state *state) {
    state->depth = state->height = 0.0;
}

#endif

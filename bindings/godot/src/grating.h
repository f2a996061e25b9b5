/* KnurlGrating: how a surface feels, as a resource that surfaces share. SPDX-License-Identifier: MIT */
#ifndef KNURL_GODOT_GRATING_H
#define KNURL_GODOT_GRATING_H

#include "classes.h"

#include <knurl/scene.h>

typedef struct grating {
    gd_instance base;
    float spatial_frequency[2]; /* cycles/m */
    double amplitude;           /* m */
    double stiffness;           /* N/m */
    double damping;             /* N s/m */
    double friction;
    double orientation;  /* rad */
    int64_t method;      /* KNURL_METHOD_DEFAULT, KNURL_METHOD_S1, ... */
    uint64_t changed_at; /* grating_changes at its last change */
} grating;

extern const gd_class grating_class;

/* Counts changes of all gratings: if it is unchanged, so are they. */
extern uint64_t grating_changes;

void grating_describe(const grating *g, knurl_material_desc *material);

#endif

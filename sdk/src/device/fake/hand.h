/* The simulated hand's target position: strokes with a tremor. Pure computation. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_HAND_H
#define KNURL_SRC_HAND_H

#include "base/finite.h"

#include <knurl/fake.h>

/* A path over a surface, with rows at even distances. */
typedef struct knurl_hand_path {
    double *rows; /* x, y, z, and the outward normal; null: no path */
    uint32_t count;
    double spacing; /* m between rows */
    double loop;    /* m from the start: a circle repeats from here */
} knurl_hand_path;

typedef struct knurl_hand {
    knurl_stroke_desc stroke; /* checked, speed resolved */
    knurl_hand_path way;      /* owned and set by the caller; zeroed: a straight stroke */
    double y[3];              /* normal x x */
    double tremor;            /* m, rms per axis */
    double path;              /* m travelled along the stroke */
    double shake[3];          /* state of the tremor: one oscillator per axis, driven by noise */
    double shake_velocity[3];
    uint64_t random;
} knurl_hand;

/* Checks a stroke. Errors: KNURL_ERROR_ARGUMENT. */
knurl_result knurl_stroke_check(knurl_stroke_desc *stroke);

/* Copies a checked stroke's path, if it has one. On failure *path is zeroed. Errors: KNURL_ERROR_ARGUMENT (rows or
 * length), KNURL_ERROR_MEMORY. */
knurl_result knurl_hand_path_create(const knurl_stroke_desc *stroke, knurl_hand_path *path);

void knurl_hand_path_destroy(knurl_hand_path *path);

/* stroke: checked. */
void knurl_hand_init(knurl_hand *hand, const knurl_stroke_desc *stroke, double tremor, uint64_t seed);

/* The target (m, device) at time t (s), if the previous call was dt earlier. */
void knurl_hand_target(knurl_hand *hand, double t, double dt, double target[3]);

#endif

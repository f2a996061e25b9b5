/* Where the simulated hand wants to be: strokes, with a tremor. Pure computation. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_HAND_H
#define KNURL_SRC_HAND_H

#include <knurl/device.h>

/* A way over a surface, its rows at even distances. */
typedef struct knurl_hand_path {
    double *rows; /* x, y, z, and the outward normal; null: no path */
    uint32_t count;
    double spacing; /* m between rows */
    double loop;    /* m from the start: where a circle goes round again from */
} knurl_hand_path;

/* Copies a checked stroke's path, if there is one. Errors: KNURL_ERROR_ARGUMENT (rows, or no length),
 * KNURL_ERROR_MEMORY; *path is zeroed then. */
knurl_result knurl_hand_path_create(const knurl_stroke_desc *stroke, knurl_hand_path *path);

void knurl_hand_path_destroy(knurl_hand_path *path);

/* m from its first row to its last. */
double knurl_hand_path_length(const knurl_hand_path *path);

/* The place so far from the start (m, kept within the path), and the normal there. */
void knurl_hand_path_at(const knurl_hand_path *path, double distance, double place[3], double normal[3]);

typedef struct knurl_hand {
    knurl_stroke_desc stroke; /* checked, speed resolved */
    knurl_hand_path way;      /* its owner's, and set by it; zeroed: straight */
    double y[3];              /* normal x x */
    double tremor;            /* m, rms an axis */
    double path;              /* m travelled along the stroke */
    double shake[3];          /* the tremor's state: an oscillator an axis, driven by noise */
    double shake_velocity[3];
    uint64_t random;
} knurl_hand;

/* Checks a stroke. Errors: KNURL_ERROR_ARGUMENT. */
knurl_result knurl_stroke_check(knurl_stroke_desc *stroke);

/* stroke: checked. */
void knurl_hand_init(knurl_hand *hand, const knurl_stroke_desc *stroke, double tremor, uint64_t seed);

/* The target (m, device) at time t (s), having been asked dt earlier. */
void knurl_hand_target(knurl_hand *hand, double t, double dt, double target[3]);

#endif

/* Paths over a surface for the simulated hand. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_HAND_PATH_H
#define KNURL_SRC_HAND_PATH_H

#include "base/finite.h"

#include <knurl/fake.h>

/* A path over a surface, with rows at even distances. */
typedef struct knurl_hand_path {
    double *rows; /* x, y, z, and the outward normal; null: no path */
    uint32_t count;
    double spacing; /* m between rows */
    double loop;    /* m from the start: a circle repeats from here */
} knurl_hand_path;

/* Copies a checked stroke's path, if it has one. On failure *path is zeroed. Errors: KNURL_ERROR_ARGUMENT (rows or
 * length), KNURL_ERROR_MEMORY. */
knurl_result knurl_hand_path_create(const knurl_stroke_desc *stroke, knurl_hand_path *path);

void knurl_hand_path_destroy(knurl_hand_path *path);

/* Length from the first row to the last, m. */
double knurl_hand_path_length(const knurl_hand_path *path);

/* The place at this distance from the start (m, clamped to the path), and its normal. */
void knurl_hand_path_at(const knurl_hand_path *path, double distance, double place[3], double normal[3]);

#endif

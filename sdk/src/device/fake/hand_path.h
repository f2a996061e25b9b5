/* Paths over a surface for the simulated hand. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_HAND_PATH_H
#define KNURL_SRC_HAND_PATH_H

#include "base/finite.h"

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

#endif

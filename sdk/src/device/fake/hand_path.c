/* Paths over a surface for the simulated hand. SPDX-License-Identifier: MIT */
#include "device/fake/hand_path.h"

#include "base/vec3.h"

#include <stdlib.h>
#include <string.h>

static double distance(const double *a, const double *b) {
    double between[3];
    vec3_sub(b, a, between);
    return vec3_length(between);
}

/* Checks the rows and computes the path's length, m. */
static knurl_result measure(const knurl_stroke_desc *stroke, double *length) {
    *length = 0.0;
    for (uint32_t i = 0; i < stroke->path_rows; i++) {
        const double *row = &stroke->path[6 * (size_t)i];
        if (!vec3_finite(row) || !(fabs(vec3_length(row + 3) - 1.0) < 1e-3)) {
            return knurl_fail(KNURL_ERROR_ARGUMENT,
                              "stroke.path: row %u: expected a finite place (m) and a unit normal", (unsigned)i);
        }
        *length += i > 0 ? distance(row - 6, row) : 0.0;
    }
    if (!(*length >= 1e-6 && *length <= 100.0)) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "stroke.path: expected a length of 1e-6 to 100 m, found %g m", *length);
    }
    return KNURL_OK;
}

/* Interpolates between row i (at 0) and row i + 1 (at 1). */
static void between(const double *rows, uint32_t i, double at, double row[6]) {
    const double *from = &rows[6 * (size_t)i];
    for (int k = 0; k < 6; k++) {
        row[k] = from[k] + at * (from[6 + k] - from[k]);
    }
    const double length = vec3_length(row + 3);
    if (length > 0.0) {
        vec3_scale(1.0 / length, row + 3, row + 3);
    }
}

/* Resamples the given rows at even distances. */
static void resample(const knurl_stroke_desc *stroke, knurl_hand_path *path) {
    double passed = 0.0; /* m up to row i */
    uint32_t i = 0;
    double step = distance(stroke->path, stroke->path + 6);
    for (uint32_t k = 0; k < path->count; k++) {
        const double wanted = path->spacing * k;
        while (i + 2 < stroke->path_rows && passed + step < wanted) {
            path->loop = i == stroke->path_loop ? passed : path->loop;
            passed += step;
            i++;
            step = distance(&stroke->path[6 * (size_t)i], &stroke->path[6 * (size_t)i + 6]);
        }
        between(stroke->path, i, step > 0.0 ? fmin(1.0, (wanted - passed) / step) : 0.0, &path->rows[6 * (size_t)k]);
    }
}

knurl_result knurl_hand_path_create(const knurl_stroke_desc *stroke, knurl_hand_path *path) {
    double length;
    memset(path, 0, sizeof *path);
    if (!stroke->path) {
        return KNURL_OK;
    }
    const knurl_result result = measure(stroke, &length);
    if (result) {
        return result;
    }
    path->rows = malloc((size_t)stroke->path_rows * 6 * sizeof *path->rows);
    if (!path->rows) {
        return knurl_fail(KNURL_ERROR_MEMORY, "stroke.path: could not get memory for %u rows",
                          (unsigned)stroke->path_rows);
    }
    path->count = stroke->path_rows;
    path->spacing = length / (path->count - 1);
    resample(stroke, path);
    return KNURL_OK;
}

void knurl_hand_path_destroy(knurl_hand_path *path) {
    free(path->rows);
    memset(path, 0, sizeof *path);
}

double knurl_hand_path_length(const knurl_hand_path *path) {
    return path->spacing * (path->count - 1);
}

void knurl_hand_path_at(const knurl_hand_path *path, double distance_m, double place[3], double normal[3]) {
    double row[6];
    const double at = fmin(fmax(distance_m / path->spacing, 0.0), (double)(path->count - 1));
    const uint32_t before = at < path->count - 2 ? (uint32_t)at : path->count - 2;
    between(path->rows, before, at - before, row);
    vec3_copy(row, place);
    vec3_copy(row + 3, normal);
}

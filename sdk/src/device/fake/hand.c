/* Strokes of the simulated hand. SPDX-License-Identifier: MIT */
#include "device/fake/hand.h"

#include "base/base.h"
#include "base/vec3.h"

#include <stdlib.h>
#include <string.h>

#define TWO_PI    6.283185307179586
#define HOVER     0.005 /* m above the surface at the start of a stroke */
#define APPROACH  0.25  /* s to come down */
#define TREMOR_HZ 10.0  /* physiological tremor of the hand: 8 to 12 Hz */

static const struct {
    int32_t stroke;
    const char *name;
} strokes[] = {{KNURL_STROKE_LINE, "line"},
               {KNURL_STROKE_SWEEP, "sweep"},
               {KNURL_STROKE_CIRCLE, "circle"},
               {KNURL_STROKE_PRESS, "press"},
               {KNURL_STROKE_REST, "rest"}};

void knurl_stroke_desc_init(knurl_stroke_desc *desc, uint32_t size) {
    const knurl_stroke_desc defaults = {.stroke = KNURL_STROKE_LINE,
                                        .x = {1.0, 0.0, 0.0},
                                        .normal = {0.0, 1.0, 0.0},
                                        .reach = {0.05, 0.02},
                                        .depth = 0.001,
                                        .period = 5.0};
    knurl_desc_write(&defaults, sizeof defaults, desc, size);
}

knurl_result knurl_stroke_from_name(const char *name, int32_t *stroke) {
    if (KNURL_IS_NULL(name) || KNURL_IS_NULL(stroke)) {
        return KNURL_ERROR_ARGUMENT;
    }
    for (size_t i = 0; i < sizeof strokes / sizeof *strokes; i++) {
        if (strcmp(strokes[i].name, name) == 0) {
            *stroke = strokes[i].stroke;
            return KNURL_OK;
        }
    }
    return knurl_fail(KNURL_ERROR_UNKNOWN, "stroke: expected line, sweep, circle, press or rest, found '%s'", name);
}

knurl_result knurl_stroke_check(knurl_stroke_desc *s) {
    if (s->stroke < KNURL_STROKE_LINE || s->stroke > KNURL_STROKE_REST) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "stroke: expected one of KNURL_STROKE_, found %d", (int)s->stroke);
    }
    if (s->path ? s->path_rows < 2 || s->path_rows > KNURL_PATH_ROWS_MAX ||
                      (s->stroke == KNURL_STROKE_CIRCLE && s->path_loop >= s->path_rows - 1)
                : s->path_rows != 0) {
        return knurl_fail(
            KNURL_ERROR_ARGUMENT,
            "stroke.path: expected 2 to %d rows and path_loop below the last, or no path and 0 rows, found "
            "%s and %u rows, path_loop %u",
            KNURL_PATH_ROWS_MAX, s->path ? "a path" : "no path", (unsigned)s->path_rows, (unsigned)s->path_loop);
    }
    if (!vec3_finite(s->centre) || !(fabs(vec3_length(s->x) - 1.0) < 1e-3) ||
        !(fabs(vec3_length(s->normal) - 1.0) < 1e-3) || !(fabs(vec3_dot(s->x, s->normal)) < 1e-3)) {
        return knurl_fail(KNURL_ERROR_ARGUMENT,
                          "stroke: expected a finite centre (m), and unit x and normal at right angles");
    }
    if (s->speed == 0.0) {
        s->speed = s->stroke == KNURL_STROKE_SWEEP ? 0.25 : 0.1;
    }
    if (!(s->reach[0] > 0.0 && s->reach[0] <= 1.0 && s->reach[1] > 0.0 && s->reach[1] <= 1.0)) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "stroke.reach: expected above 0 and up to 1 m, found [%g, %g]",
                          s->reach[0], s->reach[1]);
    }
    if (!(fabs(s->depth) <= 0.1 && s->speed > 0.0 && s->speed <= 10.0 && s->period > 0.0 && s->period <= 3600.0)) {
        return knurl_fail(KNURL_ERROR_ARGUMENT,
                          "stroke: expected depth up to 0.1 m, speed up to 10 m/s, period up to 3600 s, "
                          "found %g m, %g m/s, %g s",
                          s->depth, s->speed, s->period);
    }
    return KNURL_OK;
}

void knurl_hand_init(knurl_hand *hand, const knurl_stroke_desc *stroke, double tremor, uint64_t seed) {
    memset(hand, 0, sizeof *hand);
    hand->stroke = *stroke;
    hand->tremor = tremor;
    hand->random = seed * 0x9e3779b97f4a7c15u + 0x2545f4914f6cdd1du;
    vec3_cross(stroke->normal, stroke->x, hand->y);
}

/* xorshift64* (Vigna 2016); uniform in [-1, 1). */
static double uniform(uint64_t *state) {
    *state ^= *state >> 12;
    *state ^= *state << 25;
    *state ^= *state >> 27;
    return (double)((*state * 0x2545f4914f6cdd1du) >> 11) / 4503599627370496.0 - 1.0;
}

/* Noise through a resonance at 10 Hz with damping 0.3. White noise of variance s2 per step dt gives a position of
 * variance s2 dt / (4 zeta w^3) (Langevin); the noise is scaled for the requested rms. */
static void shake(knurl_hand *hand, double dt, double target[3]) {
    const double w = TWO_PI * TREMOR_HZ;
    const double zeta = 0.3;
    const double noise =
        hand->tremor * sqrt(4.0 * zeta * w * w * w / dt) * 1.7320508075688772; /* uniform: variance 1/3 */
    for (int axis = 0; axis < 3; axis++) {
        const double push = noise * uniform(&hand->random);
        hand->shake_velocity[axis] +=
            dt * (push - 2.0 * zeta * w * hand->shake_velocity[axis] - w * w * hand->shake[axis]);
        hand->shake[axis] += dt * hand->shake_velocity[axis];
        target[axis] += hand->shake[axis];
    }
}

/* Position of a point that moves back and forth over +-reach, as a function of the path from the middle: a triangle
 * wave with rounded turns, as a hand's. Never faster than the path; at its full speed in the middle, at half of it 2 %
 * before an end. */
static double back_and_forth(double path, double reach) {
    /* 0 is a sine; with 1 it turns so sharply that the hand's spring throws the mass past 300 mm/s */
    const double roundness = 0.98;
    const double quarter = asin(roundness);
    return reach / quarter * asin(roundness * sin(path * quarter / (roundness * reach)));
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
        *length += i > 0 ? sqrt(vec3_distance2(row - 6, row)) : 0.0;
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
    double step = sqrt(vec3_distance2(stroke->path, stroke->path + 6));
    for (uint32_t k = 0; k < path->count; k++) {
        const double wanted = path->spacing * k;
        while (i + 2 < stroke->path_rows && passed + step < wanted) {
            path->loop = i == stroke->path_loop ? passed : path->loop;
            passed += step;
            i++;
            step = sqrt(vec3_distance2(&stroke->path[6 * (size_t)i], &stroke->path[6 * (size_t)i + 6]));
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

/* The place at this distance from the start (m, clamped to the path), and its normal. */
static void path_at(const knurl_hand_path *path, double distance, double place[3], double normal[3]) {
    double row[6];
    const double at = fmin(fmax(distance / path->spacing, 0.0), (double)(path->count - 1));
    const uint32_t before = at < path->count - 2 ? (uint32_t)at : path->count - 2;
    between(path->rows, before, at - before, row);
    vec3_copy(row, place);
    vec3_copy(row + 3, normal);
}

/* Speed along the path at time t after the approach. */
static double path_speed(const knurl_stroke_desc *s, double t) {
    if (s->stroke == KNURL_STROKE_SWEEP) {
        const double u = fmod(t, s->period) / s->period;
        return s->speed * (u < 0.5 ? 2.0 * u : 2.0 - 2.0 * u);
    }
    return s->speed;
}

static int goes_back_and_forth(const knurl_stroke_desc *s) {
    return s->stroke == KNURL_STROKE_LINE || s->stroke == KNURL_STROKE_SWEEP;
}

/* The target over a flat surface, `height` above it. */
static void straight_target(const knurl_hand *hand, double height, double target[3]) {
    const knurl_stroke_desc *s = &hand->stroke;
    double x = 0.0;
    double y = 0.0;
    if (hand->path != 0.0 && goes_back_and_forth(s)) {
        x = back_and_forth(hand->path, s->reach[0]);
    } else if (hand->path != 0.0 && s->stroke == KNURL_STROKE_CIRCLE) { /* a spiral from the middle in the first turn */
        const double radius = fmin(s->reach[0], s->reach[1]);
        const double angle = hand->path / radius;
        const double grown = radius * fmin(1.0, angle / TWO_PI);
        x = grown * sin(angle);
        y = -grown * cos(angle);
    }
    vec3_madd(s->centre, x, s->x, target);
    vec3_madd(target, y, hand->y, target);
    vec3_madd(target, height, s->normal, target);
}

/* The target over a curved surface. */
static void target_on_path(const knurl_hand *hand, double height, double target[3]) {
    const double length = hand->way.spacing * (hand->way.count - 1);
    double distance = 0.5 * length;
    double normal[3];
    if (goes_back_and_forth(&hand->stroke)) {
        distance += back_and_forth(hand->path, 0.5 * length);
    } else if (hand->stroke.stroke == KNURL_STROKE_CIRCLE) {
        distance =
            hand->path <= length ? hand->path : fmod(hand->path - length, length - hand->way.loop) + hand->way.loop;
    }
    path_at(&hand->way, distance, target, normal);
    vec3_madd(target, height, normal, target);
}

void knurl_hand_target(knurl_hand *hand, double t, double dt, double target[3]) {
    const knurl_stroke_desc *s = &hand->stroke;
    const double down = fmin(1.0, t / APPROACH);
    double height = HOVER - (HOVER + s->depth) * down * down * (3.0 - 2.0 * down); /* a smooth step: no jerk at touch */
    const double moving = t - APPROACH;
    if (moving > 0.0) {
        hand->path += dt * path_speed(s, moving - 0.5 * dt);
        if (s->stroke == KNURL_STROKE_PRESS) {
            height -= s->depth * (1.0 - cos(TWO_PI * moving / s->period));
        }
    }
    if (hand->way.rows) {
        target_on_path(hand, height, target);
    } else {
        straight_target(hand, height, target);
    }
    if (hand->tremor > 0.0) {
        shake(hand, dt, target);
    }
}

/* Shapes for the tests of contact: wavy, round and random. SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_BODIES_H
#define KNURL_TEST_BODIES_H

#include "support/geometry.h"

#define PI 3.14159265358979323846

/** Waves of 30 mm by 40 mm, 3 mm high. */
static inline double wavy(double x, double y) {
    return 0.003 * sin(2.0 * PI * x / 0.03) * cos(2.0 * PI * y / 0.04);
}

static inline shape body_wavy(uint32_t n) {
    return shape_sheet(n, n, (const double[2]){0.1, 0.1}, wavy);
}

static inline shape body_box(void) {
    return shape_box((const double[3]){0.020, 0.015, 0.010}, 0);
}

/** A ring round z: 30 mm to the middle of its tube of 8 mm. */
static inline shape body_torus(uint32_t around, uint32_t tube) {
    shape s = shape_new(around * tube, 6 * around * tube, 0);
    uint32_t at = 0;
    for (uint32_t i = 0; i < around; i++) {
        for (uint32_t j = 0; j < tube; j++) {
            const double a = 2.0 * PI * i / around;
            const double b = 2.0 * PI * j / tube;
            const double r = 0.030 + 0.008 * cos(b);
            const uint32_t i1 = (i + 1) % around * tube;
            const uint32_t j1 = (j + 1) % tube;
            shape_set(&s, i * tube + j, r * cos(a), r * sin(a), 0.008 * sin(b));
            at = shape_quad(&s, at, i * tube + j, i1 + j, i1 + j1, i * tube + j1);
        }
    }
    return s;
}

/** A sphere of 30 mm, each vertex moved in or out by up to `share` of the radius. */
static inline shape body_lump(uint64_t seed, int level, double share) {
    shape s = shape_sphere(0.03, level);
    for (uint32_t v = 0; v < s.vertex_count; v++) {
        double p[3];
        const double scale = 1.0 + random_between(&seed, -share, share);
        shape_get(&s, v, p);
        shape_set(&s, v, p[0] * scale, p[1] * scale, p[2] * scale);
    }
    return s;
}

/** A height field of noise, 0.1 m wide, up to `height` high. */
static inline shape body_noise(uint64_t seed, uint32_t n, double height) {
    shape s = shape_sheet(n, n, (const double[2]){0.05, 0.05}, NULL);
    for (uint32_t v = 0; v < s.vertex_count; v++) {
        s.positions[3 * (size_t)v + 2] = (float)random_between(&seed, 0.0, height);
    }
    return s;
}

/** Triangles anywhere in a cube of 0.1 m. */
static inline shape body_soup(uint64_t seed, uint32_t triangles) {
    shape s = shape_soup(seed, triangles, 0.2);
    for (uint32_t i = 0; i < 3 * s.vertex_count; i++) {
        s.positions[i] *= 0.05f;
    }
    return s;
}

static inline shape body_copy(const shape *s) {
    assert_true(s->vertex_count > 0 && s->index_count > 0);
    shape copy = shape_new(s->vertex_count, s->index_count, 0);
    memcpy(copy.positions, s->positions, (size_t)s->vertex_count * 3 * sizeof(float));
    memcpy(copy.indices, s->indices, (size_t)s->index_count * sizeof(uint32_t));
    return copy;
}

#endif

/* Worst cases for contact: crests that reach through a mesh, crowds, heaps. They run only by their names.
 * SPDX-License-Identifier: MIT */
#include "bench.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define RADIUS   0.03 /* m: of spheres */
#define CROWD    32   /* spheres in one place: as many as a HIP's list holds */
#define PLANES   1000
#define DRIFT    0.002 /* m: a moving plane's largest distance from the middle */
#define TRIANGLE 0.05  /* m: from the middle of a heap to a corner */

/* The next number of a sequence, -1 to 1. */
static double next(uint64_t *seed) {
    *seed = *seed * 6364136223846793005U + 1442695040888963407U;
    return (double)(*seed >> 11) / 4503599627370496.0 - 1.0;
}

typedef struct soup {
    float *positions;
    uint32_t *indices;
    uint32_t corners; /* three per triangle, each with its own vertex */
} soup;

static int soup_make(uint32_t triangles, soup *s) {
    memset(s, 0, sizeof *s);
    s->positions = malloc(9 * (size_t)triangles * sizeof *s->positions);
    s->indices = malloc(3 * (size_t)triangles * sizeof *s->indices);
    return s->positions && s->indices;
}

static void soup_free(soup *s) {
    free(s->positions);
    free(s->indices);
}

static void soup_add(soup *s, const double corner[3]) {
    for (int i = 0; i < 3; i++) {
        s->positions[3 * (size_t)s->corners + (size_t)i] = (float)corner[i];
    }
    s->indices[s->corners] = s->corners;
    s->corners++;
}

/* A point of the sphere from a point (u, v) of the cube's face, -1 to 1 each. */
static void on_sphere(int face, double u, double v, double out[3]) {
    const double side = face < 3 ? 1.0 : -1.0;
    const double scale = RADIUS / sqrt(1.0 + u * u + v * v);
    out[face % 3] = side * scale;
    out[(face + 1) % 3] = u * scale;
    out[(face + 2) % 3] = side * v * scale; /* front faces outwards */
}

/* A cube's six grids, projected onto a sphere. */
static int make_sphere(uint32_t triangles, soup *s) {
    static const int corners[6][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
    const int n = (int)lround(sqrt(triangles / 12.0));
    if (!soup_make(12 * (uint32_t)(n * n), s)) {
        return 0;
    }
    for (int i = 0; i < 6 * n * n; i++) {
        for (int k = 0; k < 6; k++) {
            double p[3];
            on_sphere(i / (n * n), 2.0 * (i % n + corners[k][0]) / n - 1.0, 2.0 * (i / n % n + corners[k][1]) / n - 1.0,
                      p);
            soup_add(s, p);
        }
    }
    return 1;
}

/* Triangles that all go through one point. */
static int make_heap(uint32_t triangles, soup *s) {
    uint64_t seed = 5;
    if (!soup_make(triangles, s)) {
        return 0;
    }
    for (uint32_t i = 0; i < triangles; i++) {
        double corners[3][3] = {{0.0}};
        for (int k = 0; k < 6; k++) {
            corners[k / 3][k % 3] = TRIANGLE * next(&seed);
            corners[2][k % 3] -= corners[k / 3][k % 3];
        }
        for (int k = 0; k < 3; k++) {
            soup_add(s, corners[k]);
        }
    }
    return 1;
}

static knurl_result add(knurl_scene *scene, knurl_surface_desc *d, const bench_case *c) {
    knurl_surface_id surface;
    knurl_material_desc m;
    knurl_material_desc_init(&m, sizeof m);
    m.method = c->method;
    m.stiffness = BENCH_STIFFNESS;
    m.spatial_frequency[0] = 1.0 / BENCH_PERIOD;
    m.amplitude = c->shape == BENCH_WORST_REACH ? 1.2 * RADIUS : BENCH_AMPLITUDE;
    d->material = &m;
    const knurl_result result = knurl_scene_add_surface(scene, d, &surface);
    d->material = NULL;
    return result;
}

static knurl_result add_planes(knurl_scene *scene, const bench_case *c) {
    knurl_result result = KNURL_OK;
    for (int i = 0; i < PLANES && !result; i++) {
        knurl_surface_desc d;
        knurl_plane_desc plane;
        knurl_surface_desc_init(&d, sizeof d);
        knurl_plane_desc_init(&plane, sizeof plane);
        d.plane = &plane;
        result = add(scene, &d, c);
    }
    return result;
}

knurl_result bench_worst_add(knurl_scene *scene, const bench_case *c) {
    soup s;
    if (c->shape == BENCH_WORST_PLANES) {
        return add_planes(scene, c);
    }
    const int made = c->shape == BENCH_WORST_HEAP ? make_heap(c->triangles, &s) : make_sphere(c->triangles, &s);
    knurl_result result = made ? KNURL_OK : knurl_fail(KNURL_ERROR_MEMORY, "%s: no memory", c->name);
    for (int i = 0; i < (c->shape == BENCH_WORST_CROWD ? CROWD : 1) && !result; i++) {
        knurl_mesh_desc mesh;
        knurl_surface_desc d;
        knurl_mesh_desc_init(&mesh, sizeof mesh);
        knurl_surface_desc_init(&d, sizeof d);
        mesh.positions = s.positions;
        mesh.vertex_count = s.corners;
        mesh.index_count = s.corners;
        mesh.indices = s.indices;
        d.mesh = &mesh;
        d.axis[0] = 0.6;
        d.axis[1] = 0.64;
        d.axis[2] = 0.48;
        d.position[0] = 1e-5 * i;
        result = add(scene, &d, c);
    }
    soup_free(&s);
    return result;
}

knurl_result bench_worst_move(knurl_scene *scene, double seconds, uint32_t *moved) {
    knurl_result result = KNURL_OK;
    uint64_t seed = (uint64_t)(seconds * BENCH_FRAME_RATE + 0.5);
    for (uint32_t i = 0; i < PLANES && !result; i++) {
        double position[3];
        double rotation[4] = {0.4 * sin(i), 0.4 * sin(2.0 * i), 0.0, 1.0};
        double norm = 0.0;
        for (int k = 0; k < 3; k++) {
            position[k] = DRIFT * next(&seed);
            rotation[k] += 0.1 * next(&seed);
        }
        for (int k = 0; k < 4; k++) {
            norm += rotation[k] * rotation[k];
        }
        for (int k = 0; k < 4; k++) {
            rotation[k] /= sqrt(norm);
        }
        result = knurl_scene_set_transform(scene, knurl_scene_get_surface(scene, i), position, rotation,
                                           1.0 / BENCH_FRAME_RATE);
        ++*moved;
    }
    return result;
}

/* At up to 0.25 m/s: 2 s about the sphere, 1 s pressed into it, 2 s about its middle. */
void bench_worst_place(double seconds, double out[3]) {
    const double phase = fmod(seconds, 5.0);
    const double radius = phase < 3.0 ? 1.3 * RADIUS : 0.1 * RADIUS;
    const double turn = 0.15 / radius * seconds;
    double length = 0.0;
    out[0] = radius * sin(turn);
    out[1] = radius * sin(1.31 * turn + 1.0);
    out[2] = radius * sin(0.83 * turn + 2.0);
    for (int i = 0; i < 3; i++) {
        length += out[i] * out[i];
    }
    for (int i = 0; i < 3 && phase >= 2.0 && phase < 3.0; i++) {
        out[i] *= (RADIUS - BENCH_DEPTH) / (sqrt(length) + 1e-9);
    }
}

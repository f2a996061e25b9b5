/* Curved forms with a closed form, as meshes with normals: a grid over the form's two parameters.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_SMOOTH_H
#define KNURL_TEST_SMOOTH_H

#include "support/geometry.h"
#include "support/scenes.h"

#define SMOOTH_PI 3.14159265358979323846

/** A point of a form and its unit normal, outwards. */
typedef void smooth_form(double u, double v, double point[3], double normal[3]);

/** Parameters run over a rectangle; u and v may close on themselves. */
typedef struct smooth_patch {
    const char *name;
    smooth_form *form;
    double low[2], high[2];
    uint32_t wraps[2];
    double scale[2]; /**< m per unit of u and v, approximately: the proportions of a quad */
} smooth_patch;

typedef struct smooth_mesh {
    shape s;
    float *normals;
} smooth_mesh;

static inline void smooth_cylinder(double u, double v, double point[3], double normal[3]) {
    const double n[3] = {cos(u), sin(u), 0.0};
    memcpy(normal, n, sizeof n);
    point[0] = 0.02 * n[0];
    point[1] = 0.02 * n[1];
    point[2] = v;
}

static inline void smooth_torus(double u, double v, double point[3], double normal[3]) {
    const double n[3] = {cos(v) * cos(u), cos(v) * sin(u), sin(v)};
    memcpy(normal, n, sizeof n);
    point[0] = 0.03 * cos(u) + 0.012 * n[0];
    point[1] = 0.03 * sin(u) + 0.012 * n[1];
    point[2] = 0.012 * n[2];
}

/** z = 5 (x^2 - y^2): radii of curvature of 0.1 m in the middle. */
static inline void smooth_saddle(double u, double v, double point[3], double normal[3]) {
    const double size = sqrt(1.0 + 100.0 * (u * u + v * v));
    point[0] = u;
    point[1] = v;
    point[2] = 5.0 * (u * u - v * v);
    normal[0] = -10.0 * u / size;
    normal[1] = 10.0 * v / size;
    normal[2] = 1.0 / size;
}

/** A sheet bent round z, touched from its hollow side. */
static inline void smooth_sheet(double u, double v, double point[3], double normal[3]) {
    const double n[3] = {-cos(u), -sin(u), 0.0};
    memcpy(normal, n, sizeof n);
    point[0] = -0.04 * n[0];
    point[1] = -0.04 * n[1];
    point[2] = -v;
}

static const smooth_patch smooth_patches[] = {
    {"cylinder", smooth_cylinder, {0.0, -0.05}, {2.0 * SMOOTH_PI, 0.05}, {1, 0}, {0.02, 1.0}},
    {"torus", smooth_torus, {0.0, 0.0}, {2.0 * SMOOTH_PI, 2.0 * SMOOTH_PI}, {1, 1}, {0.036, 0.012}},
    {"saddle", smooth_saddle, {-0.04, -0.04}, {0.04, 0.04}, {0, 0}, {1.0, 1.0}},
    {"bent sheet", smooth_sheet, {-1.0, -0.04}, {1.0, 0.04}, {0, 0}, {0.04, 1.0}},
};

/** About `triangles` of them; the grid's uvs run from 0 to 1. */
static inline smooth_mesh smooth_make(const smooth_patch *p, uint32_t triangles) {
    const double wide = (p->high[0] - p->low[0]) * p->scale[0], high = (p->high[1] - p->low[1]) * p->scale[1];
    const uint32_t nu = (uint32_t)lrint(fmax(4.0, sqrt(0.5 * triangles * wide / high)));
    const uint32_t nv = (uint32_t)lrint(fmax(3.0, 0.5 * triangles / nu));
    const uint32_t columns = nu + 1, rows = nv + 1; /* a seam of the uvs if it wraps */
    smooth_mesh m = {shape_new(columns * rows, 6 * nu * nv, 1), NULL};
    uint32_t at = 0;
    m.normals = calloc((size_t)columns * rows, 3 * sizeof(float));
    for (uint32_t i = 0; i < columns; i++) {
        for (uint32_t k = 0; k < rows; k++) {
            double point[3], normal[3];
            const uint32_t vertex = i * rows + k;
            const uint32_t ui = p->wraps[0] ? i % nu : i, vk = p->wraps[1] ? k % nv : k; /* the same floats */
            p->form(p->low[0] + (p->high[0] - p->low[0]) * ui / nu, p->low[1] + (p->high[1] - p->low[1]) * vk / nv,
                    point, normal);
            shape_set(&m.s, vertex, point[0], point[1], point[2]);
            m.s.uvs[2 * vertex] = (float)i / (float)nu;
            m.s.uvs[2 * vertex + 1] = (float)k / (float)nv;
            for (size_t axis = 0; axis < 3; axis++) {
                m.normals[3 * (size_t)vertex + axis] = (float)normal[axis];
            }
            if (i < nu && k < nv) {
                at = shape_quad(&m.s, at, vertex, vertex + rows, vertex + rows + 1, vertex + 1);
            }
        }
    }
    return m;
}

/** A sphere of 30 mm: 20 x 4^level triangles. */
static inline smooth_mesh smooth_make_sphere(int level) {
    smooth_mesh m = {shape_sphere(0.03, level), NULL};
    m.normals = calloc(m.s.vertex_count, 3 * sizeof(float));
    for (size_t i = 0; i < 3 * (size_t)m.s.vertex_count; i++) {
        m.normals[i] = m.s.positions[i] / 0.03f;
    }
    return m;
}

/** A mesh's triangles apart, with the normals of their faces. */
static inline smooth_mesh smooth_make_flat(shape s) {
    smooth_mesh m = {s, NULL};
    shape_unweld(&m.s);
    m.normals = calloc(m.s.vertex_count, 3 * sizeof(float));
    for (uint32_t i = 0; i < m.s.index_count / 3; i++) {
        double corners[3][3], n[3];
        shape_corners(&m.s, i, corners);
        (void)normal3((const double (*)[3])corners, n);
        for (uint32_t k = 0; k < 9; k++) {
            m.normals[9 * i + k] = (float)n[k % 3];
        }
    }
    return m;
}

static inline void smooth_free(smooth_mesh *m) {
    shape_free(&m->s);
    free(m->normals);
}

/** How a form is felt: as its triangles, by its normals, or by normals that the library computes. */
enum { SMOOTH_FLAT, SMOOTH_GIVEN, SMOOTH_COMPUTED };

static inline surface_parts smooth_surface(const smooth_mesh *m, int how) {
    surface_parts parts = surface_mesh(&m->s);
    parts.mesh.normals = how == SMOOTH_GIVEN ? m->normals : NULL;
    parts.desc.smooth = how == SMOOTH_COMPUTED ? KNURL_SMOOTH_ON : KNURL_SMOOTH_AUTO;
    if (!m->s.uvs) {
        parts.desc.axis[0] = 0.6;
        parts.desc.axis[1] = 0.64;
        parts.desc.axis[2] = 0.48;
    }
    return parts;
}

#endif

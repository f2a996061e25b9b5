/* Shapes to touch: open sheets, boxes, spheres, grooves, random triangles. Made on the heap, freed by shape_free().
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_SHAPES_H
#define KNURL_TEST_SHAPES_H

#include "support/close.h"

#include <knurl/contact.h>

#include <stdlib.h>

/** A mesh as a caller would own it; uvs may be null. */
typedef struct shape {
    float *positions;
    float *uvs;
    uint32_t *indices;
    uint32_t vertex_count;
    uint32_t index_count;
} shape;

/** Room for `vertices` and `corners`, at least one each, because calloc() may return null for 0. */
static inline shape shape_new(uint32_t vertices, uint32_t corners, int with_uvs) {
    const size_t room = vertices > 0 ? vertices : 1;
    shape s = {calloc(room, 3 * sizeof(float)), with_uvs ? calloc(room, 2 * sizeof(float)) : NULL,
               calloc(corners > 0 ? corners : 1, sizeof(uint32_t)), vertices, corners};
    assert_non_null(s.positions);
    assert_non_null(s.indices);
    return s;
}

static inline void shape_free(shape *s) {
    free(s->positions);
    free(s->uvs);
    free(s->indices);
    memset(s, 0, sizeof *s);
}

/** One that is freed at the end of its block. */
#define SCOPED_SHAPE __attribute__((cleanup(shape_free))) shape

/** The description for a caller. */
static inline knurl_mesh_desc shape_desc(const shape *s) {
    knurl_mesh_desc desc;
    knurl_mesh_desc_init(&desc, sizeof desc);
    desc.vertex_count = s->vertex_count;
    desc.positions = s->positions;
    desc.uvs = s->uvs;
    desc.indices = s->indices;
    desc.index_count = s->index_count;
    return desc;
}

static inline void shape_set(shape *s, uint32_t vertex, double x, double y, double z) {
    s->positions[3 * (size_t)vertex] = (float)x;
    s->positions[3 * (size_t)vertex + 1] = (float)y;
    s->positions[3 * (size_t)vertex + 2] = (float)z;
}

static inline void shape_get(const shape *s, uint32_t vertex, double out[3]) {
    for (size_t axis = 0; axis < 3; axis++) {
        out[axis] = (double)s->positions[3 * (size_t)vertex + axis];
    }
}

/** The corners of triangle `i` of a shape, as they are stored. */
static inline void shape_corners(const shape *s, uint32_t i, double corners[3][3]) {
    for (uint32_t k = 0; k < 3; k++) {
        shape_get(s, s->indices[3 * i + k], corners[k]);
    }
}

/** Two triangles a, b, c and a, c, d at corner `at`; returns the next free corner. */
static inline uint32_t shape_quad(shape *s, uint32_t at, uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
    const uint32_t corners[6] = {a, b, c, a, c, d};
    memcpy(&s->indices[at], corners, sizeof corners);
    return at + 6;
}

/** An open sheet of nx x ny quads over a rectangle round the origin, front towards +z; u and v run from 0 to 1.
 * height: z at (x, y), or null for flat. */
static inline shape shape_sheet(uint32_t nx, uint32_t ny, const double half[2], double (*height)(double, double)) {
    shape s = shape_new((nx + 1) * (ny + 1), 6 * nx * ny, 1);
    uint32_t at = 0;
    for (uint32_t j = 0; j <= ny; j++) {
        for (uint32_t i = 0; i <= nx; i++) {
            const uint32_t v = j * (nx + 1) + i;
            const double x = half[0] * (2.0 * i / nx - 1.0);
            const double y = half[1] * (2.0 * j / ny - 1.0);
            shape_set(&s, v, x, y, height ? height(x, y) : 0.0);
            s.uvs[2 * v] = (float)((double)i / nx);
            s.uvs[2 * v + 1] = (float)((double)j / ny);
            if (i < nx && j < ny) {
                at = shape_quad(&s, at, v, v + 1, v + nx + 2, v + nx + 1);
            }
        }
    }
    return s;
}

/** A box round the origin whose faces point outwards, or inwards (the inside of a room) if `inwards`. */
static inline shape shape_box(const double half[3], int inwards) {
    static const uint32_t faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                         {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    shape s = shape_new(8, 36, 0);
    uint32_t at = 0;
    for (uint32_t v = 0; v < 8; v++) {
        shape_set(&s, v, v & 1 ? half[0] : -half[0], v & 2 ? half[1] : -half[1], v & 4 ? half[2] : -half[2]);
    }
    for (int f = 0; f < 6; f++) {
        const uint32_t *q = faces[f];
        at = inwards ? shape_quad(&s, at, q[0], q[3], q[2], q[1]) : shape_quad(&s, at, q[0], q[1], q[2], q[3]);
    }
    return s;
}

/** The vertex halfway between a and b on a sphere; made once an edge (searched for among those made). */
static inline uint32_t shape_halfway(shape *s, uint32_t *count, uint32_t a, uint32_t b, double radius,
                                     uint32_t (*edges)[3], uint32_t *edge_count) {
    const uint32_t low = a < b ? a : b;
    const uint32_t high = a < b ? b : a;
    for (uint32_t i = *edge_count; i-- > 0;) {
        if (edges[i][0] == low && edges[i][1] == high) {
            return edges[i][2];
        }
    }
    double p[3];
    double q[3];
    shape_get(s, a, p);
    shape_get(s, b, q);
    const double m[3] = {p[0] + q[0], p[1] + q[1], p[2] + q[2]};
    const double scale = radius / sqrt(m[0] * m[0] + m[1] * m[1] + m[2] * m[2]);
    shape_set(s, *count, m[0] * scale, m[1] * scale, m[2] * scale);
    edges[*edge_count][0] = low;
    edges[*edge_count][1] = high;
    edges[(*edge_count)++][2] = *count;
    return (*count)++;
}

/** Each triangle of a sphere in four. */
static inline void shape_refine(shape *s, double radius) {
    shape fine = shape_new(s->vertex_count + s->index_count / 2, 4 * s->index_count, 0);
    uint32_t (*edges)[3] = calloc(s->index_count / 2, sizeof *edges);
    uint32_t count = s->vertex_count;
    uint32_t edge_count = 0;
    memcpy(fine.positions, s->positions, s->vertex_count * 3 * sizeof(float));
    for (uint32_t i = 0; i < s->index_count; i += 3) {
        const uint32_t *t = &s->indices[i];
        uint32_t m[3];
        for (uint32_t k = 0; k < 3; k++) {
            m[k] = shape_halfway(&fine, &count, t[k], t[(k + 1) % 3], radius, edges, &edge_count);
        }
        const uint32_t four[12] = {t[0], m[0], m[2], t[1], m[1], m[0], t[2], m[2], m[1], m[0], m[1], m[2]};
        memcpy(&fine.indices[(size_t)4 * i], four, sizeof four);
    }
    free(edges);
    shape_free(s);
    *s = fine;
}

/** An icosphere round the origin: 20 x 4^level triangles, facing outwards. */
static inline shape shape_sphere(double radius, int level) {
    static const uint32_t faces[60] = {0, 11, 5,  0, 5,  1, 0, 1, 7, 0, 7,  10, 0, 10, 11, 1, 5, 9, 5, 11,
                                       4, 11, 10, 2, 10, 7, 6, 7, 1, 8, 3,  9,  4, 3,  4,  2, 3, 2, 6, 3,
                                       6, 8,  3,  8, 9,  4, 9, 5, 2, 4, 11, 6,  2, 10, 8,  6, 7, 9, 8, 1};
    const double g = 0.5 * (1.0 + sqrt(5.0));
    const double unit = radius / sqrt(1.0 + g * g);
    const double corners[12][3] = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                                   {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    shape s = shape_new(12, 60, 0);
    for (uint32_t v = 0; v < 12; v++) {
        shape_set(&s, v, unit * corners[v][0], unit * corners[v][1], unit * corners[v][2]);
    }
    memcpy(s.indices, faces, sizeof faces);
    for (int i = 0; i < level; i++) {
        shape_refine(&s, radius);
    }
    return s;
}

/** Separate random triangles, edges up to `size`, corners within a cube of half extent 1. */
static inline shape shape_soup(uint64_t seed, uint32_t triangles, double size) {
    shape s = shape_new(3 * triangles, 3 * triangles, 0);
    for (uint32_t i = 0; i < triangles; i++) {
        double middle[3];
        for (int axis = 0; axis < 3; axis++) {
            middle[axis] = random_between(&seed, size - 1.0, 1.0 - size);
        }
        for (uint32_t k = 0; k < 3; k++) {
            shape_set(&s, 3 * i + k, middle[0] + random_between(&seed, -size, size),
                      middle[1] + random_between(&seed, -size, size), middle[2] + random_between(&seed, -size, size));
            s.indices[3 * i + k] = 3 * i + k;
        }
    }
    return s;
}

/* Two shapes as one, each with vertices of its own; frees both. */
static inline shape shape_join(shape *a, shape *b) {
    assert_true(a->vertex_count > 0 && a->index_count > 0);
    shape s = shape_new(a->vertex_count + b->vertex_count, a->index_count + b->index_count, 0);
    memcpy(s.positions, a->positions, a->vertex_count * 3 * sizeof(float));
    memcpy(&s.positions[3 * (size_t)a->vertex_count], b->positions, b->vertex_count * 3 * sizeof(float));
    memcpy(s.indices, a->indices, a->index_count * sizeof(uint32_t));
    for (uint32_t i = 0; i < b->index_count; i++) {
        s.indices[a->index_count + i] = b->indices[i] + a->vertex_count;
    }
    shape_free(a);
    shape_free(b);
    return s;
}

/** The same shape with three vertices of its own for every triangle, as hard edges and uv seams make them. */
static inline void shape_unweld(shape *s) {
    shape apart = shape_new(s->index_count, s->index_count, s->uvs != NULL);
    for (uint32_t i = 0; i < s->index_count; i++) {
        memcpy(&apart.positions[3 * (size_t)i], &s->positions[3 * (size_t)s->indices[i]], 3 * sizeof(float));
        if (s->uvs) {
            memcpy(&apart.uvs[2 * (size_t)i], &s->uvs[2 * (size_t)s->indices[i]], 2 * sizeof(float));
        }
        apart.indices[i] = i;
    }
    shape_free(s);
    *s = apart;
}

#endif

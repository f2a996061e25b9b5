/* Normals for a mesh without: at each vertex the mean of its triangles' normals, weighted by their angles there, so
 * that it does not depend on how a face is cut into triangles (Thuermer and Wuethrich 1998). A crease parts the
 * triangles. SPDX-License-Identifier: MIT */
#include "contact/corner.h"
#include "contact/mesh_normals.h"

typedef struct draft {
    knurl_mesh *mesh;
    const float *faces; /* unit normals, x, y, z per triangle */
    double least;       /* cosine of the largest angle that is smoothed over */
} draft;

static void face_of(const draft *d, uint32_t triangle, double normal[3]) {
    for (size_t axis = 0; axis < 3; axis++) {
        normal[axis] = (double)d->faces[3 * (size_t)triangle + axis];
    }
}

/* 1 if no crease, boundary or flipped triangle ends a swing at its next edge. */
static int goes_on(const draft *d, const knurl_swing *s) {
    const uint32_t across = d->mesh->opposite[corner_slot(s->over)];
    const uint32_t apex = across & KNURL_CORNER_MASK;
    double own[3], other[3];
    if ((apex & 3) == 3 || (across & KNURL_FLIPPED)) {
        return 0;
    }
    face_of(d, s->over >> 2, own);
    face_of(d, apex >> 2, other);
    return vec3_dot(own, other) >= d->least;
}

static void add_corner(const draft *d, uint32_t corner, double sum[3]) {
    double p[3][3], ab[3], ac[3], across[3], face[3];
    const uint32_t k = corner & 3;
    knurl_mesh_corners(d->mesh, corner >> 2, p);
    vec3_sub(p[(k + 1) % 3], p[k], ab);
    vec3_sub(p[(k + 2) % 3], p[k], ac);
    vec3_cross(ab, ac, across);
    face_of(d, corner >> 2, face);
    vec3_madd(sum, atan2(vec3_length(across), vec3_dot(ab, ac)), face, sum);
}

/* packed: is stored at the corner; KNURL_NORMAL_OF_FACE: the corner is added to `sum` instead. */
static void visit(const draft *d, uint32_t corner, uint32_t packed, double sum[3]) {
    if (packed == KNURL_NORMAL_OF_FACE) {
        add_corner(d, corner, sum);
    } else {
        d->mesh->normals[corner_slot(corner)] = packed;
    }
}

/* Visits a corner and those that it is connected with round its vertex, up to creases. */
static void visit_round(const draft *d, uint32_t corner, uint32_t packed, double sum[3]) {
    const uint32_t ways[2] = {corner_next(corner), corner_last(corner)};
    visit(d, corner, packed, sum);
    for (int i = 0; i < 2; i++) {
        knurl_swing s = {corner, ways[i]};
        while (goes_on(d, &s)) {
            (void)corner_swing(d->mesh, &s);
            if (s.corner == corner) {
                return; /* all the way round */
            }
            visit(d, s.corner, packed, sum);
        }
    }
}

static void fill(const draft *d) {
    const uint32_t count = d->mesh->triangle_count;
    for (size_t i = 0; i < 3 * (size_t)count; i++) {
        d->mesh->normals[i] = KNURL_NORMAL_OF_FACE;
    }
    for (uint32_t t = 0; t < count; t++) {
        for (uint32_t k = 0; k < 3; k++) {
            double sum[3] = {0.0, 0.0, 0.0};
            if (d->mesh->normals[3 * (size_t)t + k] == KNURL_NORMAL_OF_FACE) {
                visit_round(d, 4 * t + k, KNURL_NORMAL_OF_FACE, sum);
                if (vec3_normalise(sum) > 0.0) {
                    visit_round(d, 4 * t + k, knurl_mesh_pack_normal(sum), sum);
                }
            }
        }
    }
}

knurl_result knurl_mesh_compute_normals(knurl_heap *heap, knurl_mesh *mesh) {
    const uint32_t count = mesh->triangle_count;
    float *faces = knurl_heap_alloc(heap, count, 3 * sizeof *faces);
    mesh->normals = knurl_heap_alloc(heap, count, 3 * sizeof *mesh->normals);
    const knurl_result result = faces && mesh->normals ? KNURL_OK : KNURL_ERROR_MEMORY;
    if (!result) {
        const draft d = {mesh, faces, cos(KNURL_CREASE_ANGLE)};
        for (uint32_t t = 0; t < count; t++) {
            knurl_triangle triangle;
            knurl_mesh_triangle(mesh, t, &triangle);
            for (size_t axis = 0; axis < 3; axis++) {
                faces[3 * (size_t)t + axis] = (float)triangle.normal[axis];
            }
        }
        fill(&d);
        mesh->facts.has_computed_normals = 1;
        knurl_mesh_settle_normals(heap, mesh);
    }
    knurl_heap_free(heap, faces);
    return result;
}

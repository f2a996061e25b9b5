/* Angles at the edges of a mesh, between its triangles and between the surfaces that are felt.
 * SPDX-License-Identifier: MIT */
#include "contact/mesh_facets.h"

#include "contact/corner.h"
#include "contact/mesh_normals.h"

#include <string.h>

/* rad, between unit vectors. */
static double angle_of(const double a[3], const double b[3]) {
    double across[3];
    vec3_cross(a, b, across);
    return atan2(vec3_length(across), vec3_dot(a, b));
}

static void load(const knurl_mesh *mesh, uint32_t triangle, knurl_triangle *t, double normals[3][3]) {
    knurl_mesh_triangle(mesh, triangle, t);
    for (int k = 0; k < 3; k++) {
        vec3_copy(t->normal, normals[k]);
    }
    if (mesh->normals) {
        knurl_mesh_normals(mesh, triangle, (const double (*)[3])t->corners, normals);
    }
}

static void add_edge(const knurl_mesh *mesh, uint32_t corner, uint32_t across, knurl_mesh_facets *f, double *length) {
    const uint32_t apex = across & KNURL_CORNER_MASK;
    const double side = across & KNURL_FLIPPED ? -1.0 : 1.0;
    const uint32_t ends[2] = {corner_next(corner) & 3, corner_last(corner) & 3};
    const uint32_t others[2] = {(side > 0.0 ? corner_last(apex) : corner_next(apex)) & 3,
                                (side > 0.0 ? corner_next(apex) : corner_last(apex)) & 3};
    knurl_triangle t, beyond;
    double normals[3][3], turned[3][3], angles[2], felt = 0.0;
    load(mesh, corner >> 2, &t, normals);
    load(mesh, apex >> 2, &beyond, turned);
    vec3_scale(side, beyond.normal, beyond.normal);
    angles[0] = angle_of(t.normal, beyond.normal);
    for (int i = 0; i < 2; i++) {
        vec3_scale(side, turned[others[i]], turned[others[i]]);
        felt = knurl_max(felt, angle_of(normals[ends[i]], turned[others[i]]));
    }
    angles[1] = felt > acos(KNURL_SOFT_COSINE) ? felt : 0.0;
    const double own = sqrt(vec3_distance2(t.corners[ends[0]], t.corners[ends[1]]));
    f->edges++;
    f->hard_edges += angles[1] > 0.0;
    f->facet_angle[0] += own * angles[0];
    f->facet_angle[1] = knurl_max(f->facet_angle[1], angles[0]);
    f->felt_angle[0] += own * angles[1];
    f->felt_angle[1] = knurl_max(f->felt_angle[1], angles[1]);
    *length += own;
}

void knurl_mesh_count_facets(const knurl_mesh *mesh, knurl_mesh_facets *f) {
    double length = 0.0;
    memset(f, 0, sizeof *f);
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        for (uint32_t k = 0; k < 3; k++) {
            const uint32_t corner = 4 * t + k, across = mesh->opposite[corner_slot(corner)];
            const uint32_t apex = across & KNURL_CORNER_MASK;
            if ((apex & 3) != 3 && apex > corner) {
                add_edge(mesh, corner, across, f, &length);
            }
        }
    }
    if (length > 0.0) {
        f->facet_angle[0] /= length;
        f->felt_angle[0] /= length;
    }
}

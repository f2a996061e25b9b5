/* A triangle mesh ready for contact, in the surface's own frame. Immutable once built; any number of HIPs may read it.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_MESH_H
#define KNURL_SRC_MESH_H

#include "contact/bvh.h"

#include <knurl/contact.h>

/* A corner table (Rossignac 2001). A corner of the mesh is one number: 4 times its triangle plus 0, 1 or 2. Triangles
 * stay below 2^26, so the high bits are free, and numbers that end in 3 are no corners. */
#define KNURL_CORNER_MASK       0x0fffffffu
#define KNURL_BOUNDARY          3u          /* nothing beyond this edge */
#define KNURL_NON_MANIFOLD_EDGE 7u          /* more than one triangle beyond this edge */
#define KNURL_FLIPPED           0x40000000u /* the triangle beyond this edge faces the other way */
#define KNURL_NON_MANIFOLD      0x80000000u /* of the vertex: swinging does not get round it (knurl_vertex_corners) */

/* A non-manifold vertex: its triangles are not all connected by edges that two of them share (bow ties, more than
 * two sheets on one edge), so they are listed. */
typedef struct knurl_vertex_corners {
    uint32_t vertex;
    uint32_t first; /* in non_manifold_corners */
    uint32_t count;
} knurl_vertex_corners;

/* Single precision for what is stored (half the bytes; 4e-9 m on a 0.1 m object), double for all that is computed.
 * Bytes a triangle of a closed mesh or a sheet: triangles 12, opposite 12, positions 6, nodes 12. What stands in for
 * stored fans (14 with their starts) and for welds is `opposite`: the fan round a vertex is swung through edge by edge,
 * so vertices need not be told apart from those they are welded to. */
typedef struct knurl_mesh {
    float *positions;     /* x, y, z a vertex, in the order in which the triangles use them */
    float *tangents;      /* x, y, z an attribute, or null */
    float *uvs;           /* u, v an attribute, or null */
    uint32_t *triangles;  /* three vertices each, in the hierarchy's leaf order */
    uint32_t *attributes; /* three a triangle: places in uvs and tangents; null: its vertices */
    uint32_t *opposite;   /* three a triangle: of each corner, the corner opposite the same edge beyond it, and flags */
    knurl_vertex_corners *non_manifold; /* in order of their vertices, or null */
    uint32_t *non_manifold_corners;     /* of those, one run after another, or null */
    knurl_bvh_node *nodes;              /* the hierarchy; [0] is the root */
    uint32_t vertex_count;
    uint32_t triangle_count;
    uint32_t node_count;
    uint32_t non_manifold_count;
    uint32_t dropped;        /* triangles left out for want of area, or as duplicates */
    uint32_t reversed_twins; /* triangles left out because another has the same corners, facing the other way */
    uint32_t turned;         /* triangles turned over to face as the rest of their connected component */
    uint32_t mixed;          /* triangles that still face another way than that rest */
    int32_t double_sided;    /* 1: there were reversed twins, or no front was found */
    double seam;             /* m: edges that run side by side within this touch */
    uint32_t touching;       /* pairs of triangles that touch other than along an edge that they share */
    int32_t has_axis;        /* 1: x runs along this axis, not by tangents or uvs */
    double axis[3];          /* unit */
    double uv_scale[2];      /* su, sv: area-weighted means of |dP/du|, |dP/dv|, m; 0 without uvs */
    double stretch[2][3];    /* min, mean, max over area of su / |dP/du|, and of sv / |dP/dv|; with an axis of
                                how much of it is tangent, and 1; 1 without both */
    uint32_t other_users;    /* atomic: shapes that share it, without the first */
} knurl_mesh;

/* What triangle-relative geometry a contact needs. */
typedef struct knurl_triangle {
    double corners[3][3];
    double normal[3]; /* unit, counter-clockwise side */
    double area2;     /* twice the area */
} knurl_triangle;

/* Errors: KNURL_ERROR_ARGUMENT (what, which, expected, found). */
knurl_result knurl_mesh_check(const knurl_mesh_desc *desc);

/* null is allowed */
void knurl_mesh_destroy(knurl_heap *heap, knurl_mesh *mesh);

uint64_t knurl_mesh_bytes(const knurl_mesh *mesh);

/* Three corners, as doubles. */
static inline void knurl_mesh_corners(const knurl_mesh *mesh, uint32_t triangle, double corners[3][3]) {
    const uint32_t *vertices = &mesh->triangles[3 * (size_t)triangle];
    for (int k = 0; k < 3; k++) {
        const float *p = &mesh->positions[3 * (size_t)vertices[k]];
        corners[k][0] = (double)p[0];
        corners[k][1] = (double)p[1];
        corners[k][2] = (double)p[2];
    }
}

void knurl_mesh_triangle(const knurl_mesh *mesh, uint32_t triangle, knurl_triangle *out) KNURL_NONBLOCKING;

#endif

/* A triangle mesh ready for contact, in the surface's own frame. Immutable once built: any number of HIPs may read it.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_MESH_H
#define KNURL_SRC_MESH_H

#include "contact/bvh.h"
#include "contact/shape_facts.h"

#include <knurl/contact.h>

/* Corner table (Rossignac 2001). A corner of the mesh is 4 times its triangle plus 0, 1 or 2. Triangles stay below
 * 2^26, which leaves the high bits for flags; a number whose two low bits are 3 is not a corner. */
#define KNURL_CORNER_MASK       0x0fffffffu
#define KNURL_BOUNDARY          3u          /* no triangle beyond this edge */
#define KNURL_NON_MANIFOLD_EDGE 7u          /* more than one triangle beyond this edge */
#define KNURL_FLIPPED           0x40000000u /* the triangle beyond this edge has the opposite winding */
#define KNURL_NON_MANIFOLD      0x80000000u /* of the vertex: swinging misses some triangles (knurl_vertex_corners) */

/* Maximum triangles per leaf. Compared with 4: 7 bytes per triangle less (40 instead of 46) and a tenth less to build;
 * queries that need the hierarchy (a HIP in front, within reach) take a tenth longer. */
#define KNURL_MESH_LEAF 8

/* A non-manifold vertex (a bow tie, or more than two sheets at an edge): its triangles are not all connected by edges
 * that two of them share, so its corners are listed. */
typedef struct knurl_vertex_corners {
    uint32_t vertex;
    uint32_t first; /* index in non_manifold_corners */
    uint32_t count;
} knurl_vertex_corners;

/* The edges between triangles. Angles: rad, the mean by length and the largest. */
typedef struct knurl_mesh_facets {
    uint32_t edges, hard_edges; /* all; those at which the felt normal jumps */
    double facet_angle[2];      /* between the triangles */
    double felt_angle[2];       /* between the felt surfaces */
} knurl_mesh_facets;

/* Stored in single precision (half the bytes; 4e-9 m on a 0.1 m object), computed in double. Bytes per triangle of a
 * closed mesh or a sheet: triangles 12, opposite 12, positions 6, nodes 12. `opposite` replaces stored fans (14 with
 * their starts) and welds: swinging from edge to edge round a vertex reaches all triangles at its position, whichever
 * of the welded vertices they use. */
typedef struct knurl_mesh {
    float *positions;     /* x, y, z per vertex, in the order in which the triangles use them */
    float *tangents;      /* x, y, z per attribute, or null */
    float *uvs;           /* u, v per attribute, or null */
    uint32_t *triangles;  /* three vertices per triangle, in the hierarchy's leaf order */
    uint32_t *attributes; /* three per triangle: indices in uvs and tangents; null: same as the vertices */
    uint32_t *opposite;   /* three per triangle: of each corner, the corner opposite across the edge, and flags */
    uint32_t *normals;    /* smooth mesh: three per triangle, packed (mesh_normals.h); null: all triangles are flat */
    knurl_vertex_corners *non_manifold; /* sorted by vertex, or null */
    uint32_t *non_manifold_corners;     /* the corners of those, run after run, or null */
    knurl_bvh_node *nodes;              /* the hierarchy; [0] is the root */
    uint32_t vertex_count;
    uint32_t triangle_count;
    uint32_t node_count;
    uint32_t non_manifold_count;
    int32_t double_sided; /* 1: more than a few have reversed twins, or no front was found */
    int32_t is_projected; /* 1: coordinates are positions (projection.h), without uvs and tangents */
    int32_t has_axis;     /* 1: x runs along `axis`, not along tangents or uvs */
    double axis[3];       /* unit */
    double uv_scale[2];   /* su, sv: means of |dP/du|, |dP/dv|, m (uv_scale.c); 0 without uvs */
    knurl_shape_facts facts;
    knurl_mesh_facets facets; /* guarded by the scene's lock, as the next two */
    uint32_t are_facets_counted;
    uint32_t facet_counts; /* threads that count them now; each is one of the other users */
    uint32_t other_users;  /* atomic: shapes that share it, not counting the first */
} knurl_mesh;

/* Geometry of one triangle, as used by contact. */
typedef struct knurl_triangle {
    double corners[3][3];
    double normal[3]; /* unit, on the counter-clockwise side */
    double area_twice;
} knurl_triangle;

/* Validates a description. Errors: KNURL_ERROR_ARGUMENT (field, index, expected, found). */
knurl_result knurl_mesh_check(const knurl_mesh_desc *desc);

/* Null is allowed. */
void knurl_mesh_destroy(knurl_heap *heap, knurl_mesh *mesh);

uint64_t knurl_mesh_bytes(const knurl_mesh *mesh);

/* Corners of a triangle, as doubles. */
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

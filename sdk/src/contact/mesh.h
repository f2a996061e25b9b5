/* A triangle mesh ready for contact, in the surface's own frame. Immutable once built; any number of HIPs may read it.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_MESH_H
#define KNURL_SRC_MESH_H

#include "contact/bvh.h"

#include <knurl/contact.h>

#define KNURL_NO_TRIANGLE UINT32_MAX

/* Single precision for what is stored (half the bytes; 4e-9 m on a 0.1 m object), double for all that is computed. */
typedef struct knurl_mesh {
    float *positions;    /* x, y, z a vertex */
    float *tangents;     /* x, y, z a vertex, or null */
    float *uvs;          /* u, v a vertex, or null */
    uint32_t *triangles; /* three vertices each, in the hierarchy's leaf order */
    uint32_t *welds;     /* the first vertex that stands where this one stands: seams do not cut the surface */
    uint32_t
        *fan_starts; /* of each vertex: where its fan begins; vertex_count + 1 entries; empty unless a weld's first */
    uint32_t *fans;  /* the triangles round each vertex, one run after another */
    knurl_bvh_node *nodes; /* the hierarchy; [0] is the root */
    uint32_t vertex_count;
    uint32_t triangle_count;
    uint32_t node_count;
    uint32_t dropped;        /* triangles left out for want of area, or as duplicates */
    uint32_t reversed_twins; /* triangles left out because another has the same corners, facing the other way */
    int32_t double_sided;    /* 1: there were reversed twins */
    double uv_scale[2];      /* su, sv: area-weighted means of |dP/du|, |dP/dv|, m; 0 without uvs */
    double stretch_u[3];     /* min, mean, max over area of su / |dP/du|; 1 without uvs */
} knurl_mesh;

/* What triangle-relative geometry a contact needs. */
typedef struct knurl_triangle {
    double corners[3][3];
    double normal[3]; /* unit, counter-clockwise side */
    double area2;     /* twice the area */
} knurl_triangle;

/* Errors: KNURL_ERROR_ARGUMENT (what, which, expected, found). */
knurl_result knurl_mesh_check(const knurl_mesh_desc *desc);

/* Copies, welds, and builds the hierarchy of what knurl_mesh_check() has let through.
 * Errors: KNURL_ERROR_ARGUMENT (no triangle with an area), KNURL_ERROR_MEMORY. */
knurl_result knurl_mesh_create(knurl_heap *heap, const knurl_mesh_desc *desc, knurl_mesh **mesh);

/* null is allowed */
void knurl_mesh_destroy(knurl_heap *heap, knurl_mesh *mesh);

uint64_t knurl_mesh_bytes(const knurl_mesh *mesh);

void knurl_mesh_triangle(const knurl_mesh *mesh, uint32_t triangle, knurl_triangle *out) KNURL_NONBLOCKING;

/* dP/du and dP/dv of one triangle; 0 where its uvs have no area (or there are none). */
int knurl_mesh_uv_frame(const knurl_mesh *mesh, uint32_t triangle, double du[3], double dv[3]) KNURL_NONBLOCKING;

#endif

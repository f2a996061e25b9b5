/* Normals at the corners of a smooth mesh. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_MESH_NORMALS_H
#define KNURL_SRC_MESH_NORMALS_H

#include "base/vec3.h"
#include "contact/mesh.h"

/* Packed normal: the face's. */
#define KNURL_NORMAL_OF_FACE 0x80008000u

/* Cosine of the largest angle between the normals of two triangles at a soft edge: 0.25 degrees, more than twice the
 * angle up to which a triangle is felt flat. */
#define KNURL_SOFT_COSINE 0.99999048

/* Part of knurl_mesh_create(): packs the caller's normals. corners: the caller's vertices, three per triangle of the
 * mesh. Errors: KNURL_ERROR_MEMORY. */
knurl_result knurl_mesh_pack_normals(knurl_heap *heap, const knurl_mesh_desc *desc, const uint32_t *corners,
                                     knurl_mesh *mesh);

/* Then, with the winding unified: decides which triangles are curved; frees the normals if no triangle is. */
void knurl_mesh_settle_normals(knurl_heap *heap, knurl_mesh *mesh);

/* After knurl_mesh_create(), of a mesh without normals: computes them from the triangles. Errors: KNURL_ERROR_MEMORY.
 */
knurl_result knurl_mesh_compute_normals(knurl_heap *heap, knurl_mesh *mesh);

/* A unit vector, packed. */
uint32_t knurl_mesh_pack_normal(const double normal[3]);

/* 1 if some triangle of a description is to be felt curved: not a plane. */
int knurl_mesh_curves(const knurl_mesh_desc *desc);

/* Unpacks a triangle's normals; unit. */
void knurl_mesh_normals(const knurl_mesh *mesh, uint32_t triangle, const double corners[3][3],
                        double normals[3][3]) KNURL_NONBLOCKING;

/* 1 if a triangle of a smooth mesh is felt flat. */
static inline int knurl_mesh_is_flat_at(const knurl_mesh *mesh, uint32_t triangle) {
    return mesh->normals[3 * (size_t)triangle] == KNURL_NORMAL_OF_FACE;
}

#endif

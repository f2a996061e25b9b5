/* Finds edges and vertices that a mesh's triangles share. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_MESH_ADJACENCY_H
#define KNURL_SRC_MESH_ADJACENCY_H

#include "contact/mesh.h"

/* Part of knurl_mesh_create(): fills in opposite, non_manifold and non_manifold_corners. welded: three per triangle,
 * below welded_count; equal for vertices at the same position. Errors: KNURL_ERROR_MEMORY. */
knurl_result knurl_mesh_link(knurl_heap *heap, knurl_mesh *mesh, const uint32_t *welded, uint32_t welded_count);

#endif

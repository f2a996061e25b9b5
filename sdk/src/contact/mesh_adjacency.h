/* Which triangles of a mesh share edges and vertices. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_MESH_ADJACENCY_H
#define KNURL_SRC_MESH_ADJACENCY_H

#include "contact/mesh.h"

/* Part of knurl_mesh_create(): fills in opposite, non_manifold and non_manifold_corners. welded: three a triangle,
 * below welded_count: equal where vertices stand in one place. Errors: KNURL_ERROR_MEMORY. */
knurl_result knurl_mesh_link(knurl_heap *heap, knurl_mesh *mesh, const uint32_t *welded, uint32_t welded_count);

#endif

/* Makes triangles that share edges face the same way. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_MESH_WINDING_H
#define KNURL_SRC_MESH_WINDING_H

#include "contact/mesh.h"

/* Part of knurl_mesh_create(), after knurl_mesh_link() and knurl_mesh_count_touching(). Triangles are connected at
 * edges that two of them share; in a mesh that touches itself, at edges with exactly one other triangle beside them,
 * including T-junctions. In each connected component, triangles that face against the larger area are turned over;
 * mesh->facts.turned counts them. If neither area is larger, or the surface has only one side (a Moebius strip), the
 * mesh becomes double-sided, unless it touches itself: then mesh->facts.mixed counts the triangles that stay reversed.
 * Errors: KNURL_ERROR_MEMORY. */
knurl_result knurl_mesh_unify_winding(knurl_heap *heap, knurl_mesh *mesh);

#endif

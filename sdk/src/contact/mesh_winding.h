/* Makes triangles that share edges face the same way. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_MESH_WINDING_H
#define KNURL_SRC_MESH_WINDING_H

#include "contact/mesh.h"

/* Part of knurl_mesh_create(), after knurl_mesh_link() and knurl_mesh_count_touching(). Triangles are connected at
 * edges that two of them share; where a mesh touches itself, at edges beside which there is one other triangle,
 * T-junctions included. Of a connected component, those that face another way than the larger area are turned over;
 * mesh->turned counts them. Where neither area is larger, or there is one side only (a Moebius strip), the mesh becomes
 * double-sided. One that touches itself does not: mesh->mixed counts the triangles that stay reversed. Errors:
 * KNURL_ERROR_MEMORY. */
knurl_result knurl_mesh_unify_winding(knurl_heap *heap, knurl_mesh *mesh);

#endif

/* Makes triangles that share edges face the same way. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_MESH_WINDING_H
#define KNURL_SRC_MESH_WINDING_H

#include "contact/mesh.h"

/* Part of knurl_mesh_create(), after knurl_mesh_link() and knurl_mesh_count_touching(): in each
 * component (triangles connected by edges that two of them share), those that face another way than the larger area
 * are turned over; mesh->turned counts them. Where neither area is larger, or there is one side only (a Moebius strip),
 * the mesh becomes double-sided. A mesh in which triangles touch otherwise than at a shared edge or vertex stays as it
 * is. Errors: KNURL_ERROR_MEMORY. */
knurl_result knurl_mesh_unify_winding(knurl_heap *heap, knurl_mesh *mesh);

#endif

/* Finds where a mesh touches itself elsewhere than at shared edges: T-junctions, seams with vertices on either side,
 * parts that intersect.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_MESH_TOUCH_H
#define KNURL_SRC_MESH_TOUCH_H

#include "contact/mesh.h"

/* How many pairs of a mesh's triangles come within its seam of one another other than at an edge or a vertex that they
 * share; of a mesh where that would take long, at least so many. The mesh has its hierarchy, positions and seam. */
uint32_t knurl_mesh_count_touching(const knurl_mesh *mesh);

#endif

/* Finds places at which a mesh touches itself, other than shared edges: T-junctions, seams with separate vertices on
 * either side, intersecting parts.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_MESH_TOUCH_H
#define KNURL_SRC_MESH_TOUCH_H

#include "contact/mesh.h"

/* Counts the pairs of triangles that come within the mesh's seam of one another, except at a shared edge or vertex. If
 * that would take too long, the result is a lower bound. The mesh has its hierarchy, positions and seam. */
uint32_t knurl_mesh_count_touching(const knurl_mesh *mesh);

#endif

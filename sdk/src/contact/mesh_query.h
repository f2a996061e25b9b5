/* Searches a mesh's hierarchy for the nearest point and for crossings. Iterative, bounded by the visits that they are
 * given. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_MESH_QUERY_H
#define KNURL_SRC_MESH_QUERY_H

#include "contact/contact.h"
#include "contact/mesh.h"

/* part: null: none is kept. visits: null: no limit.
 *
 * The nearest point of the mesh within `radius` of p; 0 where there is none. Fills in proxy, weights and triangle. Cut
 * short, it is the nearest of those looked at. */
int knurl_mesh_closest(const knurl_mesh *mesh, const double p[3], double radius, knurl_part *part, knurl_visits *visits,
                       knurl_contact *nearest) KNURL_NONBLOCKING;

/* Where the segment from a to b first goes through a triangle: from the front, or from either side. Returns the side
 * (+1, -1) or 0 for none. Cut short, it is the first of those looked at. */
int knurl_mesh_cross(const knurl_mesh *mesh, const double a[3], const double b[3], int double_sided, knurl_part *part,
                     knurl_visits *visits, uint32_t *triangle) KNURL_NONBLOCKING;

/* 1 where contact with the mesh, whose crests reach `reach` (m), meets a tick's limit of visits somewhere: looked for
 * at the middle of its bounds and at 64 of its triangles. */
int knurl_mesh_exceeds_visits(const knurl_mesh *mesh, double reach, uint32_t max_visits);

/* A place for a stroke to begin: the first front face on, then beside, then under the mesh, as the scene sees it by
 * `rotation` (row-major, from the mesh's axes to the scene's). A zeroed contact but for proxy, normal, weights and
 * triangle. */
void knurl_mesh_anchor(const knurl_mesh *mesh, const double rotation[9], knurl_contact *anchor);

#endif

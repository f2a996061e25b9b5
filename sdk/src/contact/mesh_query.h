/* Searches a mesh's hierarchy for the nearest point and for crossings. Iterative, bounded by the caller's visits.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_MESH_QUERY_H
#define KNURL_SRC_MESH_QUERY_H

#include "contact/contact.h"
#include "contact/mesh.h"

/* part: null: not cached. visits: null: unlimited.
 *
 * Finds the nearest point of the mesh within `radius` of p; 0 if there is no such point. Sets proxy, weights and
 * triangle. If cut short, it is the nearest of those visited. */
int knurl_mesh_closest(const knurl_mesh *mesh, const double p[3], double radius, knurl_part *part, knurl_visits *visits,
                       knurl_contact *nearest) KNURL_NONBLOCKING;

/* Finds the first triangle that the segment from a to b crosses, from the front or, if double-sided, from either side.
 * Returns the side (+1, -1), or 0 without a crossing. If cut short, it is the first of those visited. */
int knurl_mesh_cross(const knurl_mesh *mesh, const double a[3], const double b[3], int double_sided, knurl_part *part,
                     knurl_visits *visits, uint32_t *triangle) KNURL_NONBLOCKING;

/* 1 if contact with the mesh, whose crests reach `reach` (m), can meet a tick's limit of visits: tested at the middle
 * of its bounds and at 64 of its triangles. */
int knurl_mesh_exceeds_visits(const knurl_mesh *mesh, double reach, uint32_t max_visits);

/* Start of a stroke: the first front face on, then beside, then under the mesh, as seen in the scene. rotation:
 * row-major, from the mesh's axes to the scene's. Sets proxy, normal, weights and triangle, and zeroes the rest of the
 * contact. */
void knurl_mesh_anchor(const knurl_mesh *mesh, const double rotation[9], knurl_contact *anchor);

#endif

/* The walk over a mesh to the local minimum of the distance, and the side of the surface that a point is on. Everything
 * here is allowed in a tick.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_MESH_WALK_H
#define KNURL_SRC_MESH_WALK_H

#include "contact/closest_point.h"
#include "contact/visits.h"

/* Moves a closest point downhill to the local minimum of the distance to p. side: of the surface that p came from, +1
 * or -1. Returns 1 if the result may not be connected to the start: the walk jumped, was cut short or chose among many
 * sheets. visits: null: unlimited. */
int knurl_mesh_walk(const knurl_mesh *mesh, const double p[3], int32_t side, knurl_visits *visits,
                    knurl_closest_point *closest) KNURL_NONBLOCKING;

/* Side of the surface that p is on, seen from its closest point: +1 in front, -1 behind, 0 neither. visits: null:
 * unlimited. *boundary: 1 if that point is on the boundary of an open mesh. mean: if p is in front of some triangles
 * round the point and behind others, the unit mean of their normals; else 0. */
int knurl_mesh_side(const knurl_mesh *mesh, const knurl_closest_point *closest, knurl_visits *visits, int *boundary,
                    double mean[3]) KNURL_NONBLOCKING;

#endif

/* Where a point's perpendicular meets a mesh: the walk over the surface to the local minimum of the distance, and which
 * side of the surface the point is on there. Everything here may run in a tick. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_FOOT_H
#define KNURL_SRC_FOOT_H

#include "contact/corner.h"
#include "contact/triangle.h"

/* The nearest point of one triangle. */
typedef struct knurl_foot {
    double corners[3][3];
    double weights[3];
    double point[3];
    double offset[3]; /* from the point to what it is the foot of */
    double distance2;
    uint32_t triangle;
    unsigned held; /* a bit for each corner that it rests on: 7 on the inside */
} knurl_foot;

static inline void knurl_foot_find(const knurl_mesh *mesh, uint32_t triangle, const double p[3], knurl_foot *foot) {
    knurl_mesh_corners(mesh, triangle, foot->corners);
    foot->held = triangle_nearest((const double (*)[3])foot->corners, p, foot->weights);
    triangle_point((const double (*)[3])foot->corners, foot->weights, foot->point);
    vec3_sub(p, foot->point, foot->offset);
    foot->distance2 = vec3_dot(foot->offset, foot->offset);
    foot->triangle = triangle;
}

/* The normal of the foot's triangle, times twice its area. */
static inline void knurl_foot_normal(const knurl_foot *foot, double out[3]) {
    double edge1[3];
    double edge2[3];
    vec3_sub(foot->corners[1], foot->corners[0], edge1);
    vec3_sub(foot->corners[2], foot->corners[0], edge2);
    vec3_cross(edge1, edge2, out);
}

/* From a foot downhill to the local minimum of the distance to p; side: of the surface that p came from, +1 or -1. */
void knurl_foot_walk(const knurl_mesh *mesh, const double p[3], int32_t side, knurl_foot *foot);

/* Which side of the surface a point is on whose foot is on an edge or a vertex: +1 in front, -1 behind, 0 neither.
 * *rim: whether the foot is on the rim of an open mesh. */
int knurl_foot_side(const knurl_mesh *mesh, const knurl_foot *foot, int *rim);

#endif

/* Closest point of a triangle to a given point. Everything here is allowed in a tick. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_CLOSEST_POINT_H
#define KNURL_SRC_CLOSEST_POINT_H

#include "base/vec3.h"
#include "contact/mesh.h"

/* The point of one triangle closest to p. */
typedef struct knurl_closest_point {
    double corners[3][3];
    double cross[3];   /* of the edges: along the normal, twice the area long */
    double weights[3]; /* barycentric; exactly 0 for corners off the feature */
    double point[3];
    double offset[3]; /* from the point to p */
    double distance2;
    double cross2; /* its length, squared */
    uint32_t triangle;
    unsigned feature; /* vertex, edge or face that the point is on: one bit per corner; 7: the face */
} knurl_closest_point;

/* Closest edge or vertex if p does not project into the face, by Voronoi regions (Ericson 2005, section 5.1.5). inside:
 * barycentric coordinates of b and c, times cross2. */
void knurl_closest_on_edges(const double p[3], const double inside[2], knurl_closest_point *closest) KNURL_NONBLOCKING;

/* If p projects into the face, as it nearly always does, the cross product and one division suffice. */
static inline void knurl_closest_on_triangle(const knurl_mesh *mesh, uint32_t triangle, const double p[3],
                                             knurl_closest_point *closest) {
    double ab[3], ac[3], ap[3], across[3];
    knurl_mesh_corners(mesh, triangle, closest->corners);
    closest->triangle = triangle;
    vec3_sub(closest->corners[1], closest->corners[0], ab);
    vec3_sub(closest->corners[2], closest->corners[0], ac);
    vec3_sub(p, closest->corners[0], ap);
    vec3_cross(ab, ac, closest->cross);
    vec3_cross(closest->cross, ap, across);
    closest->cross2 = vec3_dot(closest->cross, closest->cross);
    const double inside[2] = {vec3_dot(across, ac), -vec3_dot(across, ab)};
    const double inverse = 1.0 / closest->cross2;
    if (!(inside[0] > 0.0 && inside[1] > 0.0 && inside[0] + inside[1] < closest->cross2)) {
        knurl_closest_on_edges(p, inside, closest);
        return;
    }
    const double height = vec3_dot(ap, closest->cross);
    vec3_scale(height * inverse, closest->cross, closest->offset);
    vec3_sub(p, closest->offset, closest->point);
    closest->distance2 = height * height * inverse;
    closest->weights[1] = inside[0] * inverse;
    closest->weights[2] = inside[1] * inverse;
    closest->weights[0] = 1.0 - closest->weights[1] - closest->weights[2];
    closest->feature = 7;
}

/* Moves a point of the mesh towards p by 1e-6 of their distance: a ray from it does not hit the face it is on. */
static inline void knurl_offset_towards(const double point[3], const double p[3], double out[3]) {
    double way[3];
    const double size = fabs(point[0]) + fabs(point[1]) + fabs(point[2]);
    vec3_sub(p, point, way);
    vec3_madd(point, 1e-6 + 1e-14 * size / (vec3_length(way) + 1e-300), way, out);
}

#endif

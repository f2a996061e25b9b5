/* The point of a triangle that is closest to another. Everything here may run in a tick. SPDX-License-Identifier: MIT
 */
#ifndef KNURL_SRC_CLOSEST_POINT_H
#define KNURL_SRC_CLOSEST_POINT_H

#include "base/vec3.h"
#include "contact/mesh.h"

/* The nearest point of one triangle. */
typedef struct knurl_foot {
    double corners[3][3];
    double normal[3];  /* of the triangle, times twice its area */
    double weights[3]; /* barycentric; 0 exactly where it does not rest */
    double point[3];
    double offset[3]; /* from the point to what it is the foot of */
    double distance2;
    double area2; /* twice the triangle's area, squared */
    uint32_t triangle;
    unsigned held; /* a bit for each corner that it rests on: 7 on the inside */
} knurl_foot;

/* Which edge or corner is nearest to a point that is not above the inside, by Voronoi regions (Ericson 2005, section
 * 5.1.5). inside: of b and c, signed, 0 on the edge that faces the corner. */
void knurl_foot_on_edge(const double p[3], const double inside[2], knurl_foot *foot) KNURL_NONBLOCKING;

/* Above the inside, which is nearly always, everything comes from the normal: one division. */
static inline void knurl_foot_find(const knurl_mesh *mesh, uint32_t triangle, const double p[3], knurl_foot *foot) {
    double ab[3], ac[3], ap[3], turn[3];
    knurl_mesh_corners(mesh, triangle, foot->corners);
    foot->triangle = triangle;
    vec3_sub(foot->corners[1], foot->corners[0], ab);
    vec3_sub(foot->corners[2], foot->corners[0], ac);
    vec3_sub(p, foot->corners[0], ap);
    vec3_cross(ab, ac, foot->normal);
    vec3_cross(foot->normal, ap, turn);
    foot->area2 = vec3_dot(foot->normal, foot->normal);
    const double inside[2] = {vec3_dot(turn, ac), -vec3_dot(turn, ab)};
    const double inverse = 1.0 / foot->area2;
    if (!(inside[0] > 0.0 && inside[1] > 0.0 && inside[0] + inside[1] < foot->area2)) {
        knurl_foot_on_edge(p, inside, foot);
        return;
    }
    const double height = vec3_dot(ap, foot->normal);
    vec3_scale(height * inverse, foot->normal, foot->offset);
    vec3_sub(p, foot->offset, foot->point);
    foot->distance2 = height * height * inverse;
    foot->weights[1] = inside[0] * inverse;
    foot->weights[2] = inside[1] * inverse;
    foot->weights[0] = 1.0 - foot->weights[1] - foot->weights[2];
    foot->held = 7;
}

/* A little (1e-6) of the way from a point of the mesh to p: where a way that leaves the surface does not meet it. */
static inline void knurl_foot_leave(const double point[3], const double p[3], double out[3]) {
    double way[3];
    const double size = fabs(point[0]) + fabs(point[1]) + fabs(point[2]);
    vec3_sub(p, point, way);
    vec3_madd(point, 1e-6 + 1e-14 * size / (vec3_length(way) + 1e-300), way, out);
}

#endif

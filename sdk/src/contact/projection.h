/* Surface coordinates without uvs: positions, in metres, projected along one axis of the surface's frame, on each
 * triangle the one that its normal is closest to. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_PROJECTION_H
#define KNURL_SRC_PROJECTION_H

#include "base/vec3.h"
#include "contact/mesh.h"

/* One of the six directions that are projected along: the axes of the coordinates, and their signs. Seen from the front
 * v is a quarter turn counter-clockwise from u. On the four sides v runs up (+y in glTF) and u counter-clockwise round,
 * so that upright ridges go on from one to the next. */
typedef struct knurl_projection {
    int u, v;
    double u_sign, v_sign;
} knurl_projection;

/* The direction, 0 to 5: +x, -x, +y, -y, +z, -z. A chamfer of 45 degrees counts as one, whatever the rounding. */
static inline int knurl_projection_side(const double normal[3]) {
    const double x = fabs(normal[0]), y = 1.01 * fabs(normal[1]), z = 1.02 * fabs(normal[2]);
    const int axis = z >= x && z >= y ? 2 : y >= x ? 1 : 0;
    return 2 * axis + (normal[axis] < 0.0);
}

/* By direction. */
static const knurl_projection knurl_projections[6] = {{2, 1, -1.0, 1.0}, {2, 1, 1.0, 1.0}, {0, 2, 1.0, -1.0},
                                                      {0, 2, 1.0, 1.0},  {0, 1, 1.0, 1.0}, {0, 1, -1.0, 1.0}};

/* Kept from tick to tick of a contact: an offset of its coordinates, and the direction at the last tick. */
typedef struct knurl_projection_carry {
    double by[2]; /* m */
    int32_t side;
    uint32_t triangle; /* of the last tick */
} knurl_projection_carry;

/* A point's coordinates, m. */
static inline void knurl_projection_place(int side, const double p[3], double coordinates[2]) {
    const knurl_projection *on = &knurl_projections[side];
    coordinates[0] = on->u_sign * p[on->u];
    coordinates[1] = on->v_sign * p[on->v];
}

/* The direction of a triangle. */
static inline int knurl_projection_side_of(const double corners[3][3]) {
    double ab[3], ac[3], across[3];
    vec3_sub(corners[1], corners[0], ab);
    vec3_sub(corners[2], corners[0], ac);
    vec3_cross(ab, ac, across);
    return knurl_projection_side(across);
}

#endif

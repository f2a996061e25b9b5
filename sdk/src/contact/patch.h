/* A triangle of a smooth mesh as it is felt: a PN triangle (Vlachos, Peters, Boyd and Mitchell 2001), a cubic patch
 * through the triangle's corners, perpendicular there to their normals. Its normal is the corners', interpolated
 * linearly. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_PATCH_H
#define KNURL_SRC_PATCH_H

#include <knurl/base.h>
#include <stdint.h>

/* The patch is the triangle, plus for each corner i a height along its normal: the cubic
 * w[i]^2 sum(3 heights[i][k] w[k]) + 1.5 w[0] w[1] w[2] sum(heights[i][k]) over the other corners k. */
typedef struct knurl_patch {
    double corners[3][3];
    double normals[3][3]; /* unit */
    double heights[3][3]; /* m: [i][k]: of the control point next to corner i towards corner k; 0 for i = k */
    uint32_t triangle;
} knurl_patch;

/* A point of a patch, below or above which a HIP is. */
typedef struct knurl_patch_point {
    double point[3];
    double normal[3];      /* unit */
    double tangents[2][3]; /* change of the point at the HIP's height for the weights of corners 1 and 2, made
                              perpendicular to the normal */
    double z;              /* m: height of the HIP along the normal */
    double beside[3];      /* m: the rest of the line to the HIP; 0 at the felt point */
} knurl_patch_point;

/* Sets a patch up from its triangle and unit normals. */
void knurl_patch_set(const double corners[3][3], const double normals[3][3], knurl_patch *patch) KNURL_NONBLOCKING;

/* The patch's point with these barycentric weights, as seen from `hip`. */
void knurl_patch_at(const knurl_patch *patch, const double weights[3], const double hip[3],
                    knurl_patch_point *at) KNURL_NONBLOCKING;

#endif

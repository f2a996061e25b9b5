/* The nearest point of a triangle. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_TRIANGLE_H
#define KNURL_SRC_TRIANGLE_H

#include "base/vec3.h"

/* Barycentric weights of the point of a triangle nearest to p (by Voronoi regions: Ericson 2005, section 5.1.5).
 * On an edge one weight is exactly 0, on a corner two are. */
static inline void triangle_nearest(const double corners[3][3], const double p[3], double weights[3]) {
    double ab[3], ac[3], ap[3], bp[3], cp[3];
    vec3_sub(corners[1], corners[0], ab);
    vec3_sub(corners[2], corners[0], ac);
    vec3_sub(p, corners[0], ap);
    vec3_sub(p, corners[1], bp);
    vec3_sub(p, corners[2], cp);
    const double d1 = vec3_dot(ab, ap), d2 = vec3_dot(ac, ap);
    const double d3 = vec3_dot(ab, bp), d4 = vec3_dot(ac, bp);
    const double d5 = vec3_dot(ab, cp), d6 = vec3_dot(ac, cp);
    const double va = d3 * d6 - d5 * d4;
    const double vb = d5 * d2 - d1 * d6;
    const double vc = d1 * d4 - d3 * d2;
    weights[0] = weights[1] = weights[2] = 0.0;
    if (d1 <= 0.0 && d2 <= 0.0) {
        weights[0] = 1.0;
    } else if (d3 >= 0.0 && d4 <= d3) {
        weights[1] = 1.0;
    } else if (d6 >= 0.0 && d5 <= d6) {
        weights[2] = 1.0;
    } else if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
        weights[1] = d1 / (d1 - d3);
        weights[0] = 1.0 - weights[1];
    } else if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
        weights[2] = d2 / (d2 - d6);
        weights[0] = 1.0 - weights[2];
    } else if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
        weights[2] = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        weights[1] = 1.0 - weights[2];
    } else {
        const double sum = va + vb + vc;
        weights[1] = vb / sum;
        weights[2] = vc / sum;
        weights[0] = 1.0 - weights[1] - weights[2];
    }
}

static inline void triangle_point(const double corners[3][3], const double weights[3], double out[3]) {
    for (int axis = 0; axis < 3; axis++) {
        out[axis] = weights[0] * corners[0][axis] + weights[1] * corners[1][axis] + weights[2] * corners[2][axis];
    }
}

#endif

/* The nearest point of a triangle. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_TRIANGLE_H
#define KNURL_SRC_TRIANGLE_H

#include "base/vec3.h"

/* Barycentric weights of the point of a triangle nearest to p (by Voronoi regions: Ericson 2005, section 5.1.5).
 * On an edge one weight is exactly 0, on a corner two are. Returns a bit for each corner that the point rests on: 7 for
 * the inside. */
static inline unsigned triangle_nearest(const double corners[3][3], const double p[3], double weights[3]) {
    double ab[3], ac[3], ap[3];
    vec3_sub(corners[1], corners[0], ab);
    vec3_sub(corners[2], corners[0], ac);
    vec3_sub(p, corners[0], ap);
    const double bb = vec3_dot(ab, ab), bc = vec3_dot(ab, ac), cc = vec3_dot(ac, ac);
    const double d1 = vec3_dot(ab, ap), d2 = vec3_dot(ac, ap);
    const double d3 = d1 - bb, d4 = d2 - bc; /* ab and ac on p from b, */
    const double d5 = d1 - bc, d6 = d2 - cc; /* and from c */
    const double va = d3 * d6 - d5 * d4;
    const double vb = d5 * d2 - d1 * d6;
    const double vc = d1 * d4 - d3 * d2;
    if (va > 0.0 && vb > 0.0 && vc > 0.0) { /* most often: above the inside */
        const double inverse = 1.0 / (va + vb + vc);
        weights[1] = vb * inverse;
        weights[2] = vc * inverse;
        weights[0] = 1.0 - weights[1] - weights[2];
        return 7;
    }
    weights[0] = weights[1] = weights[2] = 0.0;
    if (d1 <= 0.0 && d2 <= 0.0) {
        weights[0] = 1.0;
        return 1;
    }
    if (d3 >= 0.0 && d4 <= d3) {
        weights[1] = 1.0;
        return 2;
    }
    if (d6 >= 0.0 && d5 <= d6) {
        weights[2] = 1.0;
        return 4;
    }
    if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
        weights[1] = d1 / bb;
        weights[0] = 1.0 - weights[1];
        return 3;
    }
    if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
        weights[2] = d2 / cc;
        weights[0] = 1.0 - weights[2];
        return 5;
    }
    weights[2] = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    weights[1] = 1.0 - weights[2];
    return 6;
}

static inline void triangle_point(const double corners[3][3], const double weights[3], double out[3]) {
    for (int axis = 0; axis < 3; axis++) {
        out[axis] = weights[0] * corners[0][axis] + weights[1] * corners[1][axis] + weights[2] * corners[2][axis];
    }
}

#endif

/* Stylus orientations. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_QUATERNION_H
#define KNURL_SRC_QUATERNION_H

#include "base/vec3.h"

#include <string.h>

/* Unit quaternion x, y, z, w of the rotation matrix with these columns; 0, 0, 0, 0 if it is not a rotation. Divides by
 * the largest component, found from the diagonal, never by one close to 0. */
static inline void quaternion_from_axes(const double x[3], const double y[3], const double z[3], double q[4]) {
    double across[3];
    vec3_cross(x, y, across);
    memset(q, 0, 4 * sizeof *q);
    if (!(fabs(vec3_dot(across, z) - 1.0) < 0.01 && fabs(vec3_dot(x, x) - 1.0) < 0.01 &&
          fabs(vec3_dot(y, y) - 1.0) < 0.01)) {
        return;
    }
    const double squares[4] = {1.0 + x[0] - y[1] - z[2], 1.0 - x[0] + y[1] - z[2], 1.0 - x[0] - y[1] + z[2],
                               1.0 + x[0] + y[1] + z[2]}; /* times 4 */
    const double products[4][4] = {
        {squares[0], x[1] + y[0], z[0] + x[2], y[2] - z[1]},
        {x[1] + y[0], squares[1], y[2] + z[1], z[0] - x[2]},
        {z[0] + x[2], y[2] + z[1], squares[2], x[1] - y[0]},
        {y[2] - z[1], z[0] - x[2], x[1] - y[0], squares[3]},
    }; /* 4 q_i q_k */
    int most = 3;
    for (int i = 0; i < 3; i++) {
        most = squares[i] > squares[most] ? i : most;
    }
    for (int i = 0; i < 4; i++) {
        q[i] = products[most][i] / (2.0 * sqrt(squares[most]));
    }
}

#endif

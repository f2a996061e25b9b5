/* Splits an engine's matrices into position and rotation, which a surface has, and scale, which is baked into its mesh.
 * SPDX-License-Identifier: MIT */
#include "parts.h"

#include <math.h>
#include <string.h>

/* The rounding error of an object's axes, relative to the longest. */
#define ROUNDING 1e-5

/* Shorter axes count as zero. */
#define LEAST 1e-9

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static int normalise(double v[3]) {
    const double length = sqrt(dot(v, v));
    for (int i = 0; i < 3; i++) {
        v[i] /= length;
    }
    return isfinite(length) && length > LEAST;
}

/* Of a right-handed rotation. Divides by the quaternion's largest component, never by a small one. */
void knurl_session_to_quaternion(const double r[9], double q[4]) {
    const double four[4] = {1.0 + r[0] - r[4] - r[8], 1.0 - r[0] + r[4] - r[8], 1.0 - r[0] - r[4] + r[8],
                            1.0 + r[0] + r[4] + r[8]};
    const double sums[4][4] = {{four[0], r[1] + r[3], r[2] + r[6], r[7] - r[5]},
                               {r[1] + r[3], four[1], r[5] + r[7], r[2] - r[6]},
                               {r[2] + r[6], r[5] + r[7], four[2], r[3] - r[1]},
                               {r[7] - r[5], r[2] - r[6], r[3] - r[1], four[3]}};
    int best = 3;
    for (int i = 0; i < 3; i++) {
        best = four[i] > four[best] ? i : best;
    }
    double length = 0.0;
    for (int i = 0; i < 4; i++) {
        length += sums[best][i] * sums[best][i];
    }
    for (int i = 0; i < 4; i++) {
        q[i] = sums[best][i] / sqrt(length);
    }
}

/* fmax() is a function call, and this runs twice for each rotating surface. */
static double larger(double a, double b) {
    return b > a ? b : a;
}

uint32_t knurl_session_same_rest(const double a[9], const double b[9]) {
    if (KNURL_IS_NULL(a) || KNURL_IS_NULL(b)) {
        return 0;
    }
    double largest = 0.0;
    double difference = 0.0;
    for (int i = 0; i < 9; i++) {
        largest = larger(larger(largest, fabs(a[i])), fabs(b[i]));
        difference = larger(difference, fabs(a[i] - b[i]));
    }
    return difference <= ROUNDING * largest;
}

/* A right-handed frame of columns: x along the first, y as near to the second as possible. 0 if they have no volume.
 */
static int make_axes(const double columns[3][3], double axes[3][3]) {
    memcpy(axes, columns, 3 * sizeof *axes);
    int is_sound = normalise(axes[0]);
    const double along = dot(axes[0], axes[1]);
    for (int i = 0; i < 3; i++) {
        axes[1][i] -= along * axes[0][i];
    }
    is_sound = is_sound && normalise(axes[1]);
    for (int i = 0; i < 3; i++) {
        axes[2][i] = axes[0][(i + 1) % 3] * axes[1][(i + 2) % 3] - axes[0][(i + 2) % 3] * axes[1][(i + 1) % 3];
    }
    return is_sound;
}

uint32_t knurl_session_split_pose(const double matrix[12], knurl_session_pose *pose) {
    if (KNURL_IS_NULL(matrix) || KNURL_IS_NULL(pose)) {
        return 0;
    }
    static const double identity[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    knurl_session_pose made;
    double columns[3][3];
    double axes[3][3];
    for (int i = 0; i < 3; i++) {
        made.position[i] = matrix[4 * i + 3];
        for (int j = 0; j < 3; j++) {
            columns[j][i] = matrix[4 * i + j];
        }
    }
    if (!make_axes((const double (*)[3])columns, axes) || !isfinite(dot(made.position, made.position))) {
        return 0;
    }
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            made.rotation[3 * i + j] = axes[j][i];
            made.rest[3 * i + j] = dot(axes[i], columns[j]);
        }
    }
    if (!(isfinite(made.rest[8]) && fabs(made.rest[8]) > LEAST)) {
        return 0;
    }
    if (knurl_session_same_rest(made.rest, identity)) {
        memcpy(made.rest, identity, sizeof identity);
    }
    knurl_session_to_quaternion(made.rotation, made.quaternion);
    *pose = made;
    return 1;
}

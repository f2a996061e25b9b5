/* Splits transforms. SPDX-License-Identifier: MIT */
#include "pose.h"

#include <math.h>
#include <string.h>

/* How far a node's basis is off by rounding, relative to its longest axis. */
#define ROUNDING 1e-5

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static int normalise(double v[3]) {
    const double length = sqrt(dot(v, v));
    for (int i = 0; i < 3; i++) {
        v[i] /= length;
    }
    return isfinite(length) && length > 1e-9;
}

/* Of a right-handed rotation, by its largest part, so that nothing small is divided by. */
static void to_quaternion(const double r[9], double q[4]) {
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

int pose_same_rest(const double a[9], const double b[9]) {
    double largest = 0.0;
    double difference = 0.0;
    for (int i = 0; i < 9; i++) {
        largest = fmax(largest, fmax(fabs(a[i]), fabs(b[i])));
        difference = fmax(difference, fabs(a[i] - b[i]));
    }
    return difference <= ROUNDING * largest;
}

int pose_split(const gd_transform *transform, pose *out) {
    static const double identity[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    double columns[3][3];
    double axes[3][3];
    for (int i = 0; i < 3; i++) {
        out->position[i] = (double)transform->origin[i];
        for (int j = 0; j < 3; j++) {
            columns[j][i] = (double)transform->basis[i][j];
        }
    }
    memcpy(axes, columns, sizeof axes);
    int is_sound = normalise(axes[0]) && isfinite(dot(out->position, out->position));
    const double along = dot(axes[0], axes[1]);
    for (int i = 0; i < 3; i++) {
        axes[1][i] -= along * axes[0][i];
    }
    is_sound = is_sound && normalise(axes[1]);
    for (int i = 0; i < 3; i++) {
        axes[2][i] = axes[0][(i + 1) % 3] * axes[1][(i + 2) % 3] - axes[0][(i + 2) % 3] * axes[1][(i + 1) % 3];
    }
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            out->rotation[3 * i + j] = axes[j][i];
            out->rest[3 * i + j] = dot(axes[i], columns[j]);
        }
    }
    is_sound = is_sound && fabs(out->rest[8]) > 1e-9;
    if (is_sound && pose_same_rest(out->rest, identity)) {
        memcpy(out->rest, identity, sizeof identity);
    }
    to_quaternion(out->rotation, out->quaternion);
    return is_sound;
}

/* An engine's transform as Knurl wants it: where, which way, and what is left over. SPDX-License-Identifier: MIT */
#ifndef KNURL_GODOT_POSE_H
#define KNURL_GODOT_POSE_H

#include "api.h"

typedef struct pose {
    double position[3];
    double rotation[9];   /* row-major, orthonormal, right-handed */
    double quaternion[4]; /* the same: x, y, z, w */
    double rest[9];       /* scale, shear and mirror: basis = rotation * rest; exactly 1 where it is 1 within 1e-5 */
} pose;

/* 1, or 0 where a transform has no volume (a scale of 0) or is not finite. */
int pose_split(const gd_transform *transform, pose *out);

/* 1 where two rests are the same to a float's rounding. */
int pose_same_rest(const double a[9], const double b[9]);

#endif

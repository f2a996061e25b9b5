/* The arm of a WoodenHaptics: encoder counts to a position, a force to motor currents. Pure.
 *
 * Body a turns about the vertical; b (upper arm) and c (forearm) each have their own angle to the vertical, because c
 * is driven through a parallelogram. In the arm's own axes, which are CHAI3D's (x towards the user, y right, z up):
 *     x = cos A (Lb sin B + Lc sin C), y = sin A (Lb sin B + Lc sin C), z = La + Lb cos B - Lc cos C, less the origin.
 * All positions and forces here are in Knurl's device frame (x right, y up, z towards the user).
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_RAWHID_KINEMATICS_H
#define KNURL_SRC_RAWHID_KINEMATICS_H

#include <stdint.h>

typedef struct knurl_rawhid_arm {
    double length[3];    /* m */
    double origin[3];    /* m, the arm's own axes */
    double radians[3];   /* rad of a body per count */
    double milliamps[3]; /* of a motor, per N m at its body */
    double max_milliamps;
} knurl_rawhid_arm;

/* Angles A, B, C of the bodies, rad. */
void knurl_rawhid_angles(const knurl_rawhid_arm *arm, const int16_t counts[3], double angles[3]);

/* Position of the grip, m. */
void knurl_rawhid_position(const knurl_rawhid_arm *arm, const double angles[3], double position[3]);

/* d(x, y, z) / d(A, B, C), m/rad, row-major. */
void knurl_rawhid_jacobian(const knurl_rawhid_arm *arm, const double angles[3], double jacobian[9]);

/* The angles at which the grip is at `position`, elbow up. Returns 0 if the position is out of reach. */
int knurl_rawhid_inverse(const knurl_rawhid_arm *arm, const double position[3], double angles[3]);

/* 1 if the arm can have these angles. 0 if it would be folded or stretched further than its links allow, or would reach
 * backwards through its base; then the counters are wrong. */
int knurl_rawhid_is_pose(const knurl_rawhid_arm *arm, const double angles[3]);

/* Motor currents for a force (N) at the grip. If one exceeds the maximum, all are reduced by the same factor, so that
 * the force keeps its direction. */
void knurl_rawhid_currents(const knurl_rawhid_arm *arm, const double angles[3], const double force[3], int16_t ma[3]);

/* Change of a coordinate, m, if every encoder advances by one count; worst axis, at the workspace centre. */
double knurl_rawhid_resolution(const knurl_rawhid_arm *arm);

#endif

/* The arm of a WoodenHaptics: encoder counts to a position, a force to motor currents. Pure.
 *
 * Body a turns about the vertical; b (upper arm) and c (forearm) each have their own angle to the vertical, for c is
 * driven through a parallelogram. In the arm's own axes, which are CHAI3D's (x towards the user, y right, z up):
 *     x = cos A (Lb sin B + Lc sin C), y = sin A (Lb sin B + Lc sin C), z = La + Lb cos B - Lc cos C, less the origin.
 * All positions and forces here are in Knurl's device frame (x right, y up, z towards the user).
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_RAWHID_KINEMATICS_H
#define KNURL_SRC_RAWHID_KINEMATICS_H

#include <stdint.h>

typedef struct knurl_rawhid_arm {
    double length[3];    /* m */
    double origin[3];    /* m, the arm's own axes */
    double radians[3];   /* of a body, a count */
    double milliamps[3]; /* of a motor, a newton metre at its body */
    double max_milliamps;
} knurl_rawhid_arm;

/* Angles A, B, C of the bodies, rad. */
void knurl_rawhid_angles(const knurl_rawhid_arm *arm, const int16_t counts[3], double angles[3]);

/* m */
void knurl_rawhid_position(const knurl_rawhid_arm *arm, const double angles[3], double position[3]);

/* Row-major: m of x, y, z a rad of A, B, C. */
void knurl_rawhid_jacobian(const knurl_rawhid_arm *arm, const double angles[3], double jacobian[9]);

/* The angles that bring the grip there, its elbow up; 0 where none do. */
int knurl_rawhid_inverse(const knurl_rawhid_arm *arm, const double position[3], double angles[3]);

/* 1 where the arm can be so; 0: folded up or stretched out as its links cannot be, or reaching backwards through its
 * base, so that the counters do not tell where it is. */
int knurl_rawhid_is_pose(const knurl_rawhid_arm *arm, const double angles[3]);

/* The currents that push with `force` (N) at the grip. Where one would be above the greatest, all are less by the same
 * factor, so that the force keeps its direction. */
void knurl_rawhid_currents(const knurl_rawhid_arm *arm, const double angles[3], const double force[3], int16_t ma[3]);

/* How far a coordinate goes, m, when every encoder goes on by a count; of the worst axis in the middle of the
 * workspace. */
double knurl_rawhid_resolution(const knurl_rawhid_arm *arm);

#endif

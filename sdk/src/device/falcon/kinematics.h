/* Kinematics of a Novint Falcon's three legs: a delta manipulator with offset hinges (R. E. Stamper, thesis, 1997),
 * with dimensions from libnifalcon (FalconGeometry.h). Positions are in Knurl's device frame, m, from the workspace's
 * centre; angles of the upper arms, rad. Pure computation, bounded. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_FALCON_KINEMATICS_H
#define KNURL_SRC_FALCON_KINEMATICS_H

#include <stdint.h>

/* m on either side of the centre: the largest cube (to 5 mm) that the legs reach completely; its least favourable
 * corner is twelve times worse conditioned than its centre. CHAI3D's workspace of this device is as large. Novint's
 * four inches cubed, 50.8 mm, has corners that this geometry does not reach. */
#define KNURL_FALCON_WORKSPACE 0.04

/* m on either side of the centre beyond which solutions are rejected. */
#define KNURL_FALCON_REACH 0.06

/* The largest command to one motor: libnifalcon's documented limit, which neither it nor the device enforces. */
#define KNURL_FALCON_MOTOR_MOST 4096

/* The angle (rad) of an encoder count. */
double knurl_falcon_angle(double counts);

/* Angles at a position. Returns 0 and leaves `theta` unchanged if a leg does not reach or a number is not finite. */
int knurl_falcon_inverse(const double position[3], double theta[3]);

/* Position at some angles; the search starts at `position`, the last one (or 0). Returns 0 and leaves `position`
 * unchanged if no solution within reach of the centre is found. */
int knurl_falcon_forward(const double theta[3], double position[3]);

/* d theta / d x at a position with its angles, one row per leg. Returns 0 if a leg is stretched out or a number is not
 * finite. */
int knurl_falcon_jacobian(const double position[3], const double theta[3], double jacobian[9]);

/* Motor commands for a force (N), by libnifalcon's gain, which was never calibrated and is likely 1.9 to 2.9 times too
 * strong (falcon.c uses less). If one exceeds the limit, all are reduced, so that the direction is kept: by that gain
 * 4096 units make 7 N sideways and 16 N to and fro at the centre. Returns 0, and sets all to 0, if the position or the
 * force is invalid. */
int knurl_falcon_motors(const double position[3], const double theta[3], const double force[3], int16_t motors[3]);

#endif

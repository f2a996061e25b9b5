/* How a Novint Falcon's three legs hold its grip: a delta manipulator with offset hinges (R. E. Stamper, thesis, 1997),
 * its measures from libnifalcon (FalconGeometry.h). Positions are Knurl's device frame, m, from the workspace's centre;
 * angles of the upper arms, rad. Pure computation, bounded. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_FALCON_KINEMATICS_H
#define KNURL_SRC_FALCON_KINEMATICS_H

#include <stdint.h>

/* m either side of the centre: the largest cube (to 5 mm) that the legs can reach all of; its least favourable corner
 * is twelve times worse conditioned than its centre. CHAI3D's workspace of this device is as large. Novint's four
 * inches cubed, 50.8 mm, has corners that this geometry does not reach. */
#define KNURL_FALCON_WORKSPACE 0.04

/* m either side of the centre beyond which no answer is believed. */
#define KNURL_FALCON_REACH 0.06

/* The most that may be sent to one motor: libnifalcon's documentation calls this the limit, and nothing in the device
 * or there enforces it. */
#define KNURL_FALCON_MOTOR_MOST 4096

/* The angle (rad) that an encoder's count stands for. */
double knurl_falcon_angle(double counts);

/* The angles at a position. 0: no leg reaches there, or the numbers are none; `theta` is untouched then. */
int knurl_falcon_inverse(const double position[3], double theta[3]);

/* The position at some angles, looked for from `position`, the last one (or 0). 0: there is none, none within reach of
 * the centre, or none was found; `position` is untouched then. */
int knurl_falcon_forward(const double theta[3], double position[3]);

/* d theta / d x at a position with its angles, a row a leg. 0: a leg is stretched out, or the numbers are none. */
int knurl_falcon_jacobian(const double position[3], const double theta[3], double jacobian[9]);

/* What to send to the motors for a force (N), by libnifalcon's gain, which was never calibrated and is likely 1.9
 * to 2.9 times too strong (falcon.c takes less). All are reduced where one would get too much, so that the
 * direction is kept: by that gain 4096 units make 7 N sideways and 16 N to and fro at the centre. 0: no such position
 * or force; the motors get 0 then. */
int knurl_falcon_motors(const double position[3], const double theta[3], const double force[3], int16_t motors[3]);

#endif

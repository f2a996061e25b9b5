/* Kinematics of a Novint Falcon. In a leg's own plane the upper arm turns by theta about the origin; u points outward,
 * w towards the user, v along the hinge. The lower arm, a parallelogram, leaves one equation per leg,
 *
 *     h(u, v, w, theta) = |(u, w) - a (cos theta, sin theta)| - (d + e + sqrt(b^2 - v^2)) = 0,
 *
 * which is solved for theta in closed form and for the position by Newton's method; its derivatives are the Jacobian.
 * SPDX-License-Identifier: MIT */
#include "device/falcon/kinematics.h"

#include "base/vec3.h"

#include <string.h>

#define ARM    0.060   /* a: upper arm, m */
#define RODS   0.1025  /* b: the long sides of the parallelogram */
#define HINGES 0.0225  /* d + e: from its short sides to the hinges, twice 0.01125 */
#define OUT    0.02557 /* r - c: from the middle to the upper arm's axis (0.0400), less the grip's own (0.01443) */
#define SIDE   0.00191 /* s - f: offset of upper arm and grip along the hinge: -0.02309 and -0.025 */
#define CENTRE 0.12    /* of the workspace, along the axis towards the user */

#define STEPS    16    /* of Newton's method, at most; 3 or 4 from the last position, 9 at most from the centre */
#define EXACT    1e-11 /* m: residual that counts as 0 */
#define LONGEST  0.02  /* m per step */
#define FLAT     0.01  /* least volume spanned by the three rods' unit vectors: 1 at right angles, 0 in a plane */
#define STRETCH  0.05  /* sine between upper and lower arm below which a leg counts as stretched out */
#define UNITS_NM 1e4   /* libnifalcon's, uncalibrated: motor units per N m */

/* cos and sin of the legs' directions: 105, -15 and -135 degrees. */
static const double legs[3][2] = {{-0.25881904510252074, 0.96592582628906831},
                                  {0.96592582628906831, -0.25881904510252074},
                                  {-0.70710678118654757, -0.70710678118654757}};

double knurl_falcon_angle(double counts) {
    /* a capstan of 14.25 mm with an encoder of 320 lines, 4 counts per line, winds a drum of 110 mm */
    const double counts_a_turn = 320.0 * 4.0 * 0.110 / 0.01425;
    const double at_zero = 35.0 / 360.0;
    return 6.283185307179586 * (counts / counts_a_turn + at_zero);
}

/* Converts a position to the leg's own frame, with the upper arm's axis at the origin. */
static void into_leg(int leg, const double position[3], double uvw[3]) {
    const double c = legs[leg][0];
    const double s = legs[leg][1];
    uvw[0] = c * position[0] + s * position[1] - OUT;
    uvw[1] = -s * position[0] + c * position[1] - SIDE;
    uvw[2] = position[2] + CENTRE;
}

int knurl_falcon_inverse(const double position[3], double theta[3]) {
    double found[3];
    for (int leg = 0; leg < 3; leg++) {
        double p[3];
        into_leg(leg, position, p);
        const double lower = HINGES + sqrt(RODS * RODS - p[1] * p[1]);
        const double d2 = p[0] * p[0] + p[2] * p[2];
        const double cosine = (d2 + ARM * ARM - lower * lower) / (2.0 * ARM * sqrt(d2));
        if (!(fabs(cosine) <= 1.0)) { /* also if NaN: v is beyond the rods */
            return 0;
        }
        found[leg] = atan2(p[2], p[0]) - acos(cosine); /* elbows outward */
    }
    vec3_copy(found, theta);
    return 1;
}

/* One leg's equation: its residual, its gradient in the device frame, and its derivative by theta. `arm`: cos, sin of
 * theta. Returns 0 if v is beyond the rods or a number is not finite. */
static int weigh(int leg, const double position[3], const double arm[2], double *residual, double normal[3],
                 double *by_theta) {
    double p[3];
    into_leg(leg, position, p);
    const double across2 = RODS * RODS - p[1] * p[1];
    const double du = p[0] - ARM * arm[0];
    const double dw = p[2] - ARM * arm[1];
    const double lower2 = du * du + dw * dw;
    if (!(across2 > 0.0 && lower2 > 0.0 && lower2 < 1.0)) {
        return 0;
    }
    const double across = sqrt(across2);
    const double lower = sqrt(lower2);
    const double nu = du / lower;
    const double nv = p[1] / across;
    *residual = lower - (HINGES + across);
    normal[0] = legs[leg][0] * nu - legs[leg][1] * nv;
    normal[1] = legs[leg][1] * nu + legs[leg][0] * nv;
    normal[2] = dw / lower;
    *by_theta = ARM * (p[0] * arm[1] - p[2] * arm[0]) / lower;
    return 1;
}

/* Solves m x = b by Cramer's rule, for rows of about unit length. Returns 0 if they lie in a plane. */
static int solve(double m[3][3], const double b[3], double x[3]) {
    double across[3][3];
    vec3_cross(m[1], m[2], across[0]);
    vec3_cross(m[2], m[0], across[1]);
    vec3_cross(m[0], m[1], across[2]);
    const double volume = vec3_dot(m[0], across[0]);
    if (!(fabs(volume) > FLAT)) {
        return 0;
    }
    for (int axis = 0; axis < 3; axis++) {
        x[axis] = (b[0] * across[0][axis] + b[1] * across[1][axis] + b[2] * across[2][axis]) / volume;
    }
    return 1;
}

/* Of all poses with these angles accepts the device's: elbows outward, no leg stretched out, near the centre. */
static int is_pose(const double position[3], const double by_theta[3]) {
    for (int axis = 0; axis < 3; axis++) {
        if (!(by_theta[axis] < -STRETCH * ARM && fabs(position[axis]) <= KNURL_FALCON_REACH)) {
            return 0;
        }
    }
    return 1;
}

int knurl_falcon_forward(const double theta[3], double position[3]) {
    double at[3];
    double arms[3][2];
    vec3_copy(position, at);
    for (int leg = 0; leg < 3; leg++) {
        arms[leg][0] = cos(theta[leg]);
        arms[leg][1] = sin(theta[leg]);
    }
    for (int step = 0; step < STEPS; step++) {
        double residual[3];
        double normals[3][3];
        double by_theta[3];
        double back[3];
        for (int leg = 0; leg < 3; leg++) {
            if (!weigh(leg, at, arms[leg], &residual[leg], normals[leg], &by_theta[leg])) {
                return 0;
            }
        }
        if (fmax(fabs(residual[0]), fmax(fabs(residual[1]), fabs(residual[2]))) < EXACT) {
            if (!is_pose(at, by_theta)) {
                return 0;
            }
            vec3_copy(at, position);
            return 1;
        }
        if (!solve(normals, residual, back)) {
            return 0;
        }
        const double length = vec3_length(back);
        vec3_madd(at, length > LONGEST ? -LONGEST / length : -1.0, back, at);
    }
    return 0;
}

int knurl_falcon_jacobian(const double position[3], const double theta[3], double jacobian[9]) {
    double made[9];
    for (int leg = 0; leg < 3; leg++) {
        const double arm[2] = {cos(theta[leg]), sin(theta[leg])};
        double residual = 0.0;
        double normal[3];
        double by_theta = 0.0;
        if (!weigh(leg, position, arm, &residual, normal, &by_theta) || !(fabs(by_theta) > STRETCH * ARM)) {
            return 0;
        }
        vec3_scale(-1.0 / by_theta, normal, &made[3 * leg]); /* dh = 0 */
    }
    memcpy(jacobian, made, sizeof made);
    return 1;
}

int knurl_falcon_motors(const double position[3], const double theta[3], const double force[3], int16_t motors[3]) {
    double jacobian[9];
    double transposed[3][3];
    double lengths[3];
    double torque[3] = {0.0, 0.0, 0.0};
    memset(motors, 0, 3 * sizeof *motors);
    if (!knurl_falcon_jacobian(position, theta, jacobian)) {
        return 0;
    }
    /* Virtual work, F . dx = tau . J dx: J^T tau = F. The columns of J^T are scaled to unit length first, so that
     * solve() finds three unit wrenches whose sum is the force. */
    double unit[3][3];
    for (int leg = 0; leg < 3; leg++) {
        vec3_copy(&jacobian[3 * leg], unit[leg]);
        lengths[leg] = vec3_normalise(unit[leg]);
        for (int axis = 0; axis < 3; axis++) {
            transposed[axis][leg] = unit[leg][axis];
        }
    }
    if (!solve(transposed, force, torque)) {
        return 0;
    }
    double most = 0.0;
    for (int leg = 0; leg < 3; leg++) {
        torque[leg] *= -UNITS_NM / lengths[leg]; /* a positive unit lowers the arm and the count */
        most = fmax(most, fabs(torque[leg]));
    }
    if (!vec3_finite(torque)) {
        return 0;
    }
    const double share = most > KNURL_FALCON_MOTOR_MOST ? KNURL_FALCON_MOTOR_MOST / most : 1.0;
    for (int leg = 0; leg < 3; leg++) {
        motors[leg] = (int16_t)lrint(share * torque[leg]);
    }
    return 1;
}

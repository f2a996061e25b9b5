/* Kinematics of the arm. SPDX-License-Identifier: MIT */
#include "device/rawhid/kinematics.h"

#include "base/vec3.h"

#define TWO_PI 6.283185307179586

/* The arm's own axis (0: towards the user, 1: right, 2: up) of Knurl's x, y and z. */
static const int own_axis[3] = {1, 2, 0};

void knurl_rawhid_angles(const knurl_rawhid_arm *arm, const int16_t counts[3], double angles[3]) {
    for (int i = 0; i < 3; i++) {
        angles[i] = arm->radians[i] * counts[i];
    }
}

/* Distance of the grip from the vertical through the base, m. */
static double reach(const knurl_rawhid_arm *arm, const double angles[3]) {
    return arm->length[1] * sin(angles[1]) + arm->length[2] * sin(angles[2]);
}

void knurl_rawhid_position(const knurl_rawhid_arm *arm, const double angles[3], double position[3]) {
    const double out = reach(arm, angles);
    const double own[3] = {cos(angles[0]) * out, sin(angles[0]) * out,
                           arm->length[0] + arm->length[1] * cos(angles[1]) - arm->length[2] * cos(angles[2])};
    for (int axis = 0; axis < 3; axis++) {
        position[axis] = own[own_axis[axis]] - arm->origin[own_axis[axis]];
    }
}

void knurl_rawhid_jacobian(const knurl_rawhid_arm *arm, const double angles[3], double jacobian[9]) {
    const double cos_a = cos(angles[0]);
    const double sin_a = sin(angles[0]);
    const double out = reach(arm, angles);
    const double out_b = arm->length[1] * cos(angles[1]);
    const double out_c = arm->length[2] * cos(angles[2]);
    const double own[3][3] = {{-sin_a * out, cos_a * out_b, cos_a * out_c},
                              {cos_a * out, sin_a * out_b, sin_a * out_c},
                              {0.0, -arm->length[1] * sin(angles[1]), arm->length[2] * sin(angles[2])}};
    for (int axis = 0; axis < 3; axis++) {
        vec3_copy(own[own_axis[axis]], &jacobian[3 * axis]);
    }
}

int knurl_rawhid_inverse(const knurl_rawhid_arm *arm, const double position[3], double angles[3]) {
    double own[3];
    for (int axis = 0; axis < 3; axis++) {
        own[own_axis[axis]] = position[axis] + arm->origin[own_axis[axis]];
    }
    const double b = arm->length[1];
    const double c = arm->length[2];
    const double out = sqrt(own[0] * own[0] + own[1] * own[1]);
    const double up = own[2] - arm->length[0];
    const double far = sqrt(out * out + up * up); /* from the shoulder */
    if (!(far > 0.0 && out > 0.0)) {
        return 0;
    }
    /* law of cosines: cosines of the angles between the links and the line from shoulder to grip */
    const double at_shoulder = (b * b + far * far - c * c) / (2.0 * b * far);
    const double at_grip = (c * c + far * far - b * b) / (2.0 * c * far);
    if (!(fabs(at_shoulder) <= 1.0 && fabs(at_grip) <= 1.0)) {
        return 0;
    }
    const double rise = atan2(up, out);
    angles[0] = atan2(own[1], own[0]);
    angles[1] = 0.25 * TWO_PI - rise - acos(at_shoulder);
    angles[2] = 0.25 * TWO_PI + rise - acos(at_grip);
    return 1;
}

int knurl_rawhid_is_pose(const knurl_rawhid_arm *arm, const double angles[3]) {
    /* B + C is the elbow's angle: 0 folded, pi stretched. Links with a thickness stop more than 0.2 rad before both,
     * and beyond that the forces would grow without limit. */
    return sin(angles[1] + angles[2]) > 0.2 && reach(arm, angles) > 0.0;
}

void knurl_rawhid_currents(const knurl_rawhid_arm *arm, const double angles[3], const double force[3], int16_t ma[3]) {
    double jacobian[9];
    double torque[3];
    double wanted[3];
    double greatest = 0.0;
    knurl_rawhid_jacobian(arm, angles, jacobian);
    mat3_mul_transposed(jacobian, force, torque);
    for (int i = 0; i < 3; i++) {
        wanted[i] = torque[i] * arm->milliamps[i];
        greatest = fmax(greatest, fabs(wanted[i]));
    }
    if (!vec3_finite(wanted)) {
        ma[0] = ma[1] = ma[2] = 0;
        return;
    }
    const double share = greatest > arm->max_milliamps ? arm->max_milliamps / greatest : 1.0;
    for (int i = 0; i < 3; i++) {
        ma[i] = (int16_t)floor(fmin(share * fabs(wanted[i]) + 0.5, arm->max_milliamps));
        ma[i] = (int16_t)(wanted[i] < 0.0 ? -ma[i] : ma[i]);
    }
}

double knurl_rawhid_resolution(const knurl_rawhid_arm *arm) {
    static const double centre[3] = {0.0, 0.0, 0.0};
    double angles[3];
    double jacobian[9];
    double worst = 0.0;
    if (!knurl_rawhid_inverse(arm, centre, angles)) {
        return 0.0; /* not reached: geometries are refused if the arm does not reach the centre */
    }
    knurl_rawhid_jacobian(arm, angles, jacobian);
    for (int axis = 0; axis < 3; axis++) {
        double step = 0.0;
        for (int i = 0; i < 3; i++) {
            step += fabs(jacobian[3 * axis + i] * arm->radians[i]);
        }
        worst = fmax(worst, step);
    }
    return worst;
}

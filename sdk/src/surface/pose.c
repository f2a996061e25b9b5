/* Poses and motions between them. SPDX-License-Identifier: MIT */
#include "surface/pose.h"

#include <string.h>

/* s: shorter motions would have an infinite speed. Less than any tick. */
#define LEAST_SECONDS 1e-9

static void mat3_product(const double a[9], const double b[9], double out[9]) {
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 3; column++) {
            out[3 * row + column] =
                a[3 * row] * b[column] + a[3 * row + 1] * b[3 + column] + a[3 * row + 2] * b[6 + column];
        }
    }
}

void knurl_pose_settle(knurl_pose *pose) {
    pose->is_rotated = 0;
    for (int i = 0; i < 9; i++) {
        pose->is_rotated |= pose->rotation[i] != (i % 4 == 0 ? 1.0 : 0.0);
    }
}

void knurl_pose_compose(const knurl_pose *outer, const knurl_pose *inner, knurl_pose *out) {
    knurl_pose made;
    knurl_pose_to_parent(outer, inner->position, made.position);
    mat3_product(outer->rotation, inner->rotation, made.rotation);
    knurl_pose_settle(&made);
    *out = made;
}

/* The rotation about a unit axis (Rodrigues). */
static void axis_to_matrix(const double axis[3], double angle, double m[9]) {
    const double c = cos(angle);
    const double s = sin(angle);
    const double *a = axis;
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 3; column++) {
            m[3 * row + column] = (1.0 - c) * a[row] * a[column] + (row == column ? c : 0.0);
        }
    }
    m[1] -= s * a[2];
    m[2] += s * a[1];
    m[3] += s * a[2];
    m[5] -= s * a[0];
    m[6] -= s * a[1];
    m[7] += s * a[0];
}

/* The rotation from a to b: a unit axis and an angle, 0 to pi. */
static double turn_between(const double a[9], const double b[9], double axis[3]) {
    double m[9]; /* b * transposed a */
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 3; column++) {
            m[3 * row + column] = vec3_dot(&b[3 * row], &a[3 * column]);
        }
    }
    axis[0] = m[7] - m[5];
    axis[1] = m[2] - m[6];
    axis[2] = m[3] - m[1];
    const double sine2 = vec3_normalise(axis);
    const double cosine2 = m[0] + m[4] + m[8] - 1.0;
    if (sine2 < 1e-8 && cosine2 < 0.0) { /* half a turn: the axis is the longest column of m + 1 */
        int longest = 0;
        for (int i = 1; i < 3; i++) {
            longest = m[4 * i] > m[4 * longest] ? i : longest;
        }
        for (int i = 0; i < 3; i++) {
            axis[i] = m[3 * i + longest] + (i == longest ? 1.0 : 0.0);
        }
        (void)vec3_normalise(axis);
    }
    return atan2(sine2, cosine2);
}

/* s since the start, at most the motion's duration. */
static double elapsed(const knurl_motion *motion, double time) {
    return knurl_min(knurl_max(time - motion->start_time, 0.0), motion->end_time - motion->start_time);
}

void knurl_motion_at(const knurl_motion *motion, double time, knurl_pose *pose) {
    if (knurl_motion_is_over(motion, time)) {
        *pose = motion->end;
        return;
    }
    const double s = elapsed(motion, time);
    double arm[3];
    double rotation[9];
    vec3_copy(motion->arm, arm);
    *pose = motion->start;
    if (motion->rate != 0.0) {
        axis_to_matrix(motion->axis, motion->rate * s, rotation);
        mat3_mul(rotation, motion->arm, arm);
        mat3_product(rotation, motion->start.rotation, pose->rotation);
        pose->is_rotated = 1;
    }
    for (int i = 0; i < 3; i++) {
        pose->position[i] = motion->start.position[i] + s * motion->velocity[i] + (arm[i] - motion->arm[i]);
    }
}

void knurl_motion_velocity(const knurl_motion *motion, double time, double period, const double point[3],
                           double velocity[3]) {
    const double middle = time - 0.5 * period;
    velocity[0] = velocity[1] = velocity[2] = 0.0;
    if (knurl_motion_is_over(motion, middle) || middle < motion->start_time) {
        return;
    }
    vec3_copy(motion->velocity, velocity);
    if (motion->rate != 0.0) {
        double from_origin[3];
        double turning[3];
        for (int i = 0; i < 3; i++) {
            from_origin[i] =
                point[i] - (motion->start.position[i] - motion->arm[i] + elapsed(motion, time) * motion->velocity[i]);
        }
        vec3_cross(motion->axis, from_origin, turning);
        vec3_madd(velocity, motion->rate, turning, velocity);
    }
}

void knurl_motion_place(const knurl_pose *origin, const knurl_pose *local, knurl_motion *motion) {
    memset(motion, 0, sizeof *motion);
    knurl_pose_compose(origin, local, &motion->end);
    motion->start = motion->end;
}

void knurl_motion_go(knurl_motion *motion, const knurl_pose *target, const knurl_pose *local, double now,
                     double seconds) {
    const knurl_motion before = *motion;
    knurl_pose here;
    double body[9];
    double origin[3];
    knurl_motion_at(&before, now, &here);
    knurl_motion_place(target, local, motion);
    motion->jumps = before.jumps;
    motion->start_time = motion->end_time = now;
    if (!(seconds > 0.0)) {
        motion->jumps++;
        return;
    }
    seconds = knurl_max(seconds, LEAST_SECONDS);
    /* the body's rotation: the frame's without the local one */
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 3; column++) {
            body[3 * row + column] = vec3_dot(&here.rotation[3 * row], &local->rotation[3 * column]);
        }
    }
    mat3_mul(body, local->position, motion->arm);
    vec3_sub(here.position, motion->arm, origin);
    vec3_sub(target->position, origin, motion->velocity);
    vec3_scale(1.0 / seconds, motion->velocity, motion->velocity);
    motion->rate = turn_between(here.rotation, motion->end.rotation, motion->axis) / seconds;
    motion->start = here;
    motion->end_time = now + seconds;
}

/* The pose of a frame, and its motion from one pose to another in a given time. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_POSE_H
#define KNURL_SRC_POSE_H

#include "base/vec3.h"

#include <knurl/base.h>

#include <stdint.h>

/* A frame in its parent's: parent = position + rotation * own. */
typedef struct knurl_pose {
    double position[3];
    int64_t is_rotated; /* 0: the rotation is the identity, as it mostly is, and is skipped */
    double rotation[9]; /* row-major */
} knurl_pose;

/* A motion from one pose to another: the origin moves in a straight line and the frame rotates at a constant rate. The
 * frame may be off the origin that it rotates about. */
typedef struct knurl_motion {
    double start_time;  /* s, scene time */
    double end_time;    /* s; start_time or earlier: at rest */
    uint64_t jumps;     /* jumps so far; a jump sweeps nothing in between */
    knurl_pose end;     /* exact pose from end_time on */
    knurl_pose start;   /* pose at start_time */
    double arm[3];      /* at start_time, from the origin to the frame, scene axes */
    double velocity[3]; /* m/s of the origin */
    double axis[3];     /* unit, scene axes */
    double rate;        /* rad/s about it */
} knurl_motion;

static inline void knurl_pose_vector_to_own(const knurl_pose *pose, const double parent[3], double own[3]) {
    if (pose->is_rotated) {
        mat3_mul_transposed(pose->rotation, parent, own);
    } else {
        vec3_copy(parent, own);
    }
}

static inline void knurl_pose_vector_to_parent(const knurl_pose *pose, const double own[3], double parent[3]) {
    if (pose->is_rotated) {
        mat3_mul(pose->rotation, own, parent);
    } else {
        vec3_copy(own, parent);
    }
}

static inline void knurl_pose_to_own(const knurl_pose *pose, const double parent[3], double own[3]) {
    double offset[3];
    vec3_sub(parent, pose->position, offset);
    knurl_pose_vector_to_own(pose, offset, own);
}

static inline void knurl_pose_to_parent(const knurl_pose *pose, const double own[3], double parent[3]) {
    double offset[3];
    knurl_pose_vector_to_parent(pose, own, offset);
    vec3_madd(pose->position, 1.0, offset, parent);
}

/* Sets is_rotated from the rotation. */
void knurl_pose_settle(knurl_pose *pose);

/* outer * inner: inner's frame in outer's parent. */
void knurl_pose_compose(const knurl_pose *outer, const knurl_pose *inner, knurl_pose *out);

static inline int knurl_motion_is_over(const knurl_motion *motion, double time) {
    return time >= motion->end_time;
}

/* The pose at a time; before start_time, the start pose. Allowed in a tick. */
void knurl_motion_at(const knurl_motion *motion, double time, knurl_pose *pose) KNURL_NONBLOCKING;

/* The velocity, over the `period` that ends at `time`, of the point of the moving body that is then at `point` (scene,
 * m); 0 if most of the period lies before the motion or after it. Allowed in a tick. */
void knurl_motion_velocity(const knurl_motion *motion, double time, double period, const double point[3],
                           double velocity[3]) KNURL_NONBLOCKING;

/* Sets a frame at rest. origin: the body's frame in the scene; local: the moving frame in the body's. */
void knurl_motion_place(const knurl_pose *origin, const knurl_pose *local, knurl_motion *motion);

/* Starts a motion from the pose of `motion` at `now` to a target pose of the body's frame in `seconds` (0: a jump). */
void knurl_motion_go(knurl_motion *motion, const knurl_pose *target, const knurl_pose *local, double now,
                     double seconds);

#endif

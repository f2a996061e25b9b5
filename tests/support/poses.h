/* Positions and rotations of surfaces, by other formulas than the library's. SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_POSES_H
#define KNURL_TEST_POSES_H

#include "support/geometry.h"
#include "support/scenes.h"

/** A pose for a surface, and the same point or direction in the scene. */
typedef struct pose {
    double position[3];
    double quaternion[4];
} pose;

static inline void turn(const double q[4], const double v[3], double out[3]) {
    for (int i = 0; i < 3; i++) { /* v + 2 u x (u x v + w v), u the vector part */
        const int j = (i + 1) % 3;
        const int k = (i + 2) % 3;
        const double inner_j = q[k] * v[i] - q[i] * v[k] + q[3] * v[j];
        const double inner_k = q[i] * v[j] - q[j] * v[i] + q[3] * v[k];
        out[i] = v[i] + 2.0 * (q[j] * inner_k - q[k] * inner_j);
    }
}

static inline pose random_pose(uint64_t *seed) {
    pose p;
    double norm = 0.0;
    for (int i = 0; i < 4; i++) {
        p.quaternion[i] = random_between(seed, -1.0, 1.0);
        norm += p.quaternion[i] * p.quaternion[i];
    }
    for (int i = 0; i < 4; i++) {
        p.quaternion[i] /= sqrt(norm);
        p.position[i % 3] = random_between(seed, -0.5, 0.5);
    }
    return p;
}

/** A turn by `angle` (rad) about a unit axis. */
static inline void turn_about(const double axis[3], double angle, double q[4]) {
    for (int i = 0; i < 3; i++) {
        q[i] = sin(0.5 * angle) * axis[i];
    }
    q[3] = cos(0.5 * angle);
}

/** out = a b: first b, then a. */
static inline void turn_after(const double a[4], const double b[4], double out[4]) {
    double across[3];
    cross3(a, b, across);
    for (int i = 0; i < 3; i++) {
        out[i] = a[3] * b[i] + b[3] * a[i] + across[i];
    }
    out[3] = a[3] * b[3] - dot3(a, b);
}

/** A point of a surface's frame in the scene. */
static inline void pose_point(const pose *p, const double local[3], double out[3]) {
    turn(p->quaternion, local, out);
    add3(p->position, 1.0, out, out);
}

static inline void place(surface_parts *parts, const pose *p) {
    memcpy(parts->desc.position, p->position, sizeof p->position);
    memcpy(parts->desc.rotation, p->quaternion, sizeof p->quaternion);
}

/** A plane's centre and axes in the scene, now. */
typedef struct plane_frame {
    double centre[3], axes[3][3];
} plane_frame;

static inline plane_frame frame_of(const knurl_scene *scene, knurl_surface_id plane) {
    plane_frame found;
    knurl_surface_info info;
    knurl_surface_info_init(&info, sizeof info);
    assert_int_equal(knurl_scene_get_surface_info(scene, plane, &info), KNURL_OK);
    memcpy(found.centre, info.anchor, sizeof found.centre);
    memcpy(found.axes[0], info.anchor_x, sizeof info.anchor_x);
    memcpy(found.axes[2], info.anchor_normal, sizeof info.anchor_normal);
    cross3(found.axes[2], found.axes[0], found.axes[1]);
    return found;
}

/** Moves a surface, which must work. */
static inline void move_to(knurl_scene *scene, knurl_surface_id surface, const pose *p, double seconds) {
    assert_int_equal(knurl_scene_set_transform(scene, surface, p->position, p->quaternion, seconds), KNURL_OK);
}

#endif

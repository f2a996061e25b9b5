/* A workspace that is moved while its HIP ticks: the game thread gives a motion, the tick follows it.
 * SPDX-License-Identifier: MIT */
#include "scene/hip_workspace.h"

#include <string.h>

/* Takes over a motion that was given since the last tick; while it is being written, the one before goes on. */
static int take(knurl_workspace_move *move) {
    const uint64_t sequence = knurl_load_acquire(&move->sequence);
    knurl_motion given;
    if (sequence == move->seen || !knurl_seqlock_try_read(&move->sequence, move->given, &given, sizeof given)) {
        return 0;
    }
    const int jumped = given.jumps != move->motion.jumps;
    move->motion = given;
    move->seen = sequence; /* where a newer one came in between, the next tick copies that once more */
    return jumped;
}

int knurl_workspace_advance(knurl_workspace_move *move, double time, knurl_workspace *workspace, int32_t *is_rotated) {
    const int jumped = take(move);
    if (move->seen == 0) {
        return 0; /* the first motion is being written */
    }
    knurl_pose pose;
    knurl_motion_at(&move->motion, time, &pose);
    vec3_copy(pose.position, workspace->origin);
    memcpy(workspace->rotation, pose.rotation, sizeof workspace->rotation);
    *is_rotated = pose.is_rotated != 0;
    move->is_on = !knurl_motion_is_over(&move->motion, time);
    return jumped;
}

static void to_pose(const knurl_workspace *workspace, knurl_pose *pose) {
    vec3_copy(workspace->origin, pose->position);
    memcpy(pose->rotation, workspace->rotation, sizeof pose->rotation);
    knurl_pose_settle(pose);
}

void knurl_workspace_go(knurl_workspace_move *move, const knurl_workspace *start, const knurl_workspace *target,
                        double now, double seconds) {
    static const knurl_pose identity = {{0.0, 0.0, 0.0}, 0, {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0}};
    knurl_pose pose;
    if (move->sequence == 0) {
        to_pose(start, &pose);
        knurl_motion_place(&pose, &identity, &move->latest);
    }
    to_pose(target, &pose);
    knurl_motion_go(&move->latest, &pose, &identity, now, seconds);
    knurl_seqlock_write(&move->sequence, move->given, &move->latest, sizeof move->latest);
}

void knurl_workspace_target(const knurl_workspace_move *move, const knurl_workspace *start, knurl_workspace *target) {
    knurl_workspace_init(target);
    target->scale = start->scale;
    if (move->sequence == 0) {
        *target = *start;
    } else {
        vec3_copy(move->latest.end.position, target->origin);
        memcpy(target->rotation, move->latest.end.rotation, sizeof target->rotation);
    }
}

/* A workspace that is moved and zoomed while its HIP ticks: the game thread sets a motion, the tick follows it.
 * SPDX-License-Identifier: MIT */
#include "hip/hip_workspace.h"

#include <knurl/hip.h>

#include <string.h>

/* s: shortest time for a change of scale by a factor of e. A HIP whose device is 0.1 m off its origin then moves, in
 * device metres, at 0.5 m/s, the fastest growth of a depth under the entry ramp. */
#define ZOOM_TIME 0.2

static double scale_at(const knurl_zoom *zoom, double time) {
    if (time >= zoom->end_time) {
        return zoom->end;
    }
    const double share = knurl_max(time - zoom->start_time, 0.0) / (zoom->end_time - zoom->start_time);
    return zoom->start * exp(share * (log(zoom->end) - log(zoom->start)));
}

/* Copies a motion set since the last tick, unless it is still being written. Returns 1 if it jumps. */
static int take(knurl_workspace_move *move) {
    const uint64_t sequence = knurl_load_acquire(&move->sequence);
    knurl_workspace_motion given;
    if (sequence == move->seen || !knurl_seqlock_try_read(&move->sequence, move->given, &given, sizeof given)) {
        return 0;
    }
    const int jumped = given.frame.jumps != move->motion.frame.jumps;
    move->motion = given;
    move->seen = sequence; /* if a newer one was written meanwhile, the next tick copies it again */
    return jumped;
}

int knurl_workspace_advance(knurl_workspace_move *move, double time, knurl_workspace *workspace, int32_t *is_rotated) {
    const int jumped = take(move);
    if (move->seen == 0) {
        return 0; /* the first motion is being written */
    }
    knurl_pose pose;
    knurl_motion_at(&move->motion.frame, time, &pose);
    vec3_copy(pose.position, workspace->origin);
    memcpy(workspace->rotation, pose.rotation, sizeof workspace->rotation);
    workspace->scale = scale_at(&move->motion.zoom, time);
    *is_rotated = pose.is_rotated != 0;
    move->is_on = !knurl_motion_is_over(&move->motion.frame, time) | (time < move->motion.zoom.end_time);
    return jumped;
}

static void to_pose(const knurl_workspace *workspace, knurl_pose *pose) {
    vec3_copy(workspace->origin, pose->position);
    memcpy(pose->rotation, workspace->rotation, sizeof pose->rotation);
    knurl_pose_settle(pose);
}

static void zoom_to(knurl_zoom *zoom, double scale, double now, double seconds) {
    if (scale == zoom->end && seconds > 0.0) {
        return; /* already under way */
    }
    zoom->start = scale_at(zoom, now);
    zoom->end = scale;
    zoom->start_time = zoom->end_time = now;
    if (seconds > 0.0) {
        zoom->end_time += knurl_max(seconds, ZOOM_TIME * fabs(log(scale) - log(zoom->start)));
    }
}

void knurl_workspace_go(knurl_workspace_move *move, const knurl_workspace *start, const knurl_workspace *target,
                        double now, double seconds) {
    static const knurl_pose identity = {{0.0, 0.0, 0.0}, 0, {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0}};
    knurl_pose pose;
    if (move->sequence == 0) {
        to_pose(start, &pose);
        knurl_motion_place(&pose, &identity, &move->latest.frame);
        move->latest.zoom.end = start->scale;
    }
    to_pose(target, &pose);
    knurl_motion_go(&move->latest.frame, &pose, &identity, now, seconds);
    zoom_to(&move->latest.zoom, target->scale, now, seconds);
    knurl_seqlock_write(&move->sequence, move->given, &move->latest, sizeof move->latest);
}

void knurl_workspace_target(const knurl_workspace_move *move, const knurl_workspace *start, knurl_workspace *target) {
    knurl_workspace_set_identity(target);
    if (move->sequence == 0) {
        *target = *start;
    } else {
        vec3_copy(move->latest.frame.end.position, target->origin);
        memcpy(target->rotation, move->latest.frame.end.rotation, sizeof target->rotation);
        target->scale = move->latest.zoom.end;
    }
}

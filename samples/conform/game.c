/* The random calls of a trial's game: one table. SPDX-License-Identifier: MIT */
#include "trial.h"

#include <math.h>
#include <string.h>

static void matrix_of(const double q[4], double m[9]) {
    const double x = q[0], y = q[1], z = q[2], w = q[3];
    const double rows[9] = {1 - 2 * (y * y + z * z), 2 * (x * y - z * w),     2 * (x * z + y * w),
                            2 * (x * y + z * w),     1 - 2 * (x * x + z * z), 2 * (y * z - x * w),
                            2 * (x * z - y * w),     2 * (y * z + x * w),     1 - 2 * (x * x + y * y)};
    memcpy(m, rows, sizeof rows);
}

static void turn_workspace(trial *t) {
    knurl_workspace w;
    double quaternion[4];
    const double kind = trial_uniform(t);
    if (knurl_scene_get_workspace(t->scene, 0, &w)) {
        return;
    }
    trial_rotation(t, kind < 0.4 ? 3.14159265358979 : trial_between(t, -3.0, 3.0), quaternion);
    matrix_of(quaternion, w.rotation);
    if (kind > 0.8) {
        w.scale = trial_scale(t, 0.3, 3.0);
    }
    for (int axis = 0; axis < 3; axis++) {
        w.origin[axis] += trial_uniform(t) < 0.5 ? 0.0 : trial_between(t, -0.005, 0.005);
    }
    judge_edits(t->j);
    (void)knurl_scene_set_workspace(t->scene, 0, &w, trial_duration(t));
}

/* --- forces --- */

static void add_force(trial *t) {
    double force[3];
    trial_direction(t, force);
    const double strength = trial_uniform(t) < 0.2 ? 0.0 : t->info.max_force * trial_scale(t, 0.01, 2.0);
    for (int axis = 0; axis < 3; axis++) {
        force[axis] *= strength;
    }
    (void)knurl_loop_set_force(t->loop, force);
}

static void vibrate(trial *t) {
    double along[3];
    const int32_t method = KNURL_WAVE_T1 + trial_below(t, 3);
    const double hz = trial_scale(t, 1.0, 0.499 * t->rate);
    const double amplitude = t->info.max_force * trial_scale(t, 0.01, 1.0);
    const double seconds = trial_uniform(t) < 0.2 ? 0.0 : trial_scale(t, 0.005, 0.2);
    trial_direction(t, along);
    judge_vibrate(t->j, method, hz, amplitude, seconds);
    (void)knurl_loop_vibrate(t->loop, method, hz, amplitude, along, seconds);
}

static void change_gain(trial *t) {
    const double kind = trial_uniform(t);
    t->j->gain = kind < 0.4 ? 0.0 : kind < 0.8 ? 1.0 : trial_uniform(t);
    (void)knurl_loop_set_gain(t->loop, t->j->gain);
}

static void pause(trial *t) {
    t->j->paused = 1;
    knurl_loop_pause(t->loop);
}

static void resume(trial *t) {
    t->j->paused = 0;
    knurl_loop_resume(t->loop);
}

static void halt(trial *t) {
    t->j->halted = t->is_stepped; /* otherwise a tick that runs now may still have a force */
    knurl_device_halt(t->device);
}

/* --- the table --- */

static const struct {
    const char *name;
    void (*act)(trial *t);
    int weight;
    int waits; /* 1: it runs ticks, which are judged */
} acts[] = {{"a surface was moved", trial_move_surface, 8, 0},
            {"a surface closed over the hand", trial_close_over, 6, 1},
            {"a surface was added", trial_add_surface, 3, 0},
            {"a surface was removed", trial_remove_surface, 2, 0},
            {"a surface was replaced", trial_replace_surface, 2, 0},
            {"a material was changed", trial_change_material, 3, 0},
            {"the workspace was turned", turn_workspace, 5, 0},
            {"a force was added", add_force, 4, 0},
            {"a vibration was added", vibrate, 2, 0},
            {"the gain was set", change_gain, 3, 0},
            {"a pause", pause, 2, 0},
            {"a resume", resume, 4, 0},
            {"a halt", halt, 2, 0},
            {"a fault of the device", trial_inject, 2, 1},
            {"another loop", trial_change_loop, 1, 1}};

void trial_act(trial *t) {
    int total = 0;
    for (size_t i = 0; i < sizeof acts / sizeof *acts; i++) {
        total += acts[i].weight;
    }
    int left = trial_below(t, total);
    size_t which = 0;
    while (left >= acts[which].weight) {
        left -= acts[which++].weight;
    }
    judge_wait(t->j);
    t->j->after = acts[which].name;
    if (acts[which].waits) {
        judge_leave(t->j);
    }
    acts[which].act(t);
    if (!acts[which].waits) {
        judge_leave(t->j);
    }
}

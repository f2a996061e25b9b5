/* The parts of a trial that wait: device faults and recovery, another loop, a force after recovery; and its ends.
 * SPDX-License-Identifier: MIT */
#include "trial.h"

#include <string.h>

/* s: time limit for detecting a fault and zeroing the force. Longer than an old position or force stays valid; a
 * library that owns the servo thread may take 60 ms more to report it. */
#define SETTLED 0.06
#define SEEN    0.15

/* Faults that were not injected are the device's own; late threads are the machine's. */
static void take_events(trial *t) {
    knurl_device_event event;
    while (knurl_device_next_event(t->device, &event)) {
        t->j->faults[event.code & 63]++;
        t->faults += event.code < KNURL_FAULT_RESUMED && event.code != KNURL_FAULT_OVERRUN &&
                     event.code != KNURL_FAULT_GAP && event.code != KNURL_FAULT_WATCHDOG &&
                     event.code != KNURL_FAULT_LATE;
    }
}

static void breaks(trial *t, int promise) {
    judge_wait(t->j);
    judge_breaks(t->j, promise, 0.0);
    judge_leave(t->j);
}

static void expect_limp(trial *t) {
    if (t->on->is_limp && !t->on->is_limp()) {
        breaks(t, JUDGE_SILENCED);
    }
}

static void expect_no_faults(trial *t) {
    t->faults = 0;
    take_events(t);
    if (t->faults > 0) {
        breaks(t, JUDGE_ANSWERS);
    }
}

/* Up to 2 s: the loop tries to reopen a lost device four times a second. */
static void wait_until_well(trial *t) {
    uint64_t ticked = 0;
    for (int i = 0; i < 200 && ticked < 40; i++) {
        knurl_loop_stats stats;
        knurl_loop_stats_init(&stats, sizeof stats);
        trial_advance(t, 10);
        ticked += knurl_loop_get_stats(t->loop, &stats) == KNURL_OK && !stats.absent ? 10 : 0;
    }
}

void trial_inject(trial *t) {
    if (t->on->faults == 0) {
        return;
    }
    trial_advance(t, 30); /* a jump needs an earlier position */
    expect_no_faults(t);
    const int no_force_until_well = t->on->inject(1 + trial_below(t, t->on->faults));
    trial_advance(t, (int)(((t->is_stepped ? SETTLED : SEEN) + t->on->alone_s) * t->rate));
    take_events(t);
    if (t->faults == 0) {
        breaks(t, JUDGE_REPORTED);
    }
    if (no_force_until_well) {
        expect_limp(t);
    }
    (void)t->on->inject(0);
    wait_until_well(t);
    take_events(t);
    t->faults = 0;
}

/* If writes are not seen, the last force of the ramp is read from the scene. */
static void end_loop(trial *t) {
    t->j->ending = 1;
    knurl_loop_destroy(t->loop);
    t->loop = NULL;
    knurl_tick_output last;
    memset(&last, 0, sizeof last);
    if (!t->j->sees_writes) { /* a destroyed scene reports nothing */
        (void)(t->scene && knurl_scene_get_tick(t->scene, 0, &last, NULL));
        memcpy(t->j->force, last.device_force, sizeof t->j->force);
    }
    judge_expect_zero(t->j, JUDGE_ENDED);
    expect_limp(t);
}

void trial_change_loop(trial *t) {
    const double ramp_s = trial_ramp(t);
    end_loop(t);
    judge_begin_loop(t->j, ramp_s);
    for (int i = 0; i < t->surface_count; i++) {
        knurl_material_desc material;
        knurl_material_desc_init(&material, sizeof material);
        if (knurl_scene_get_material(t->scene, t->surfaces[i], &material) == KNURL_OK) {
            judge_surface_is(t->j, t->surfaces[i], &material);
        }
    }
    (void)trial_make_loop(t, ramp_s);
}

/* If a force is held and there is no fault, the device must get it. */
void trial_prove_alive(trial *t) {
    const double force[3] = {0.0, 0.3 * t->info.max_force, 0.0};
    uint64_t with = 0;
    judge_wait(t->j);
    t->j->after = "all was well again";
    t->j->paused = 0;
    t->j->gain = 1.0;
    judge_leave(t->j);
    knurl_loop_resume(t->loop);
    (void)knurl_loop_set_gain(t->loop, 1.0);
    (void)knurl_loop_set_force(t->loop, force);
    for (int i = 0; i < 200 && !with; i++) {
        knurl_tick_output latest;
        trial_advance(t, 10);
        (void)knurl_scene_get_tick(t->scene, 0, &latest, NULL);
        const double *f = latest.device_force;
        with += i >= 10 && f[0] * f[0] + f[1] * f[1] + f[2] * f[2] > 0.0;
    }
    if (!with) {
        breaks(t, JUDGE_ALIVE);
    }
    expect_no_faults(t);
}

void trial_end(trial *t) {
    int which = trial_below(t, 4);
    which = which == 0 && t->on->close != knurl_device_close ? 2 : which;
    if (which == 0) { /* the device is closed under its loop */
        t->j->after = "the device was closed under its loop";
        knurl_device_close(t->device);
        judge_expect_zero(t->j, JUDGE_CLOSED);
        t->j->closed = 1;
        trial_advance(t, trial_below(t, 4));
    } else if (which == 1) {
        t->j->after = "the scene was destroyed under its loop";
        knurl_scene_destroy(t->scene);
        trial_advance(t, 5);
        t->scene = NULL;
    } else if (which == 2) {
        t->j->after = "the loop was stopped";
        t->j->ending = 1;
        knurl_loop_stop(t->loop);
        trial_advance(t, 5);
    }
    end_loop(t);
    if (which != 0) {
        t->j->after = "the device was closed";
        t->on->close(t->device);
        judge_expect_zero(t->j, JUDGE_CLOSED);
    }
    if (t->on->closed) {
        t->on->closed();
    }
    knurl_scene_destroy(t->scene);
}

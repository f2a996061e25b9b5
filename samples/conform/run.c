/* A trial, from start to end. Read trial_run(), at the end, first. SPDX-License-Identifier: MIT */
#include "trial.h"

#include <string.h>

#define ACTS  60 /* of a trial */
#define SLACK 6  /* ticks by which a haptic thread's judgement may be late */

static void no_force(uint64_t tick, const knurl_device_sample *sample, double force[3], void *user) {
    (void)tick;
    (void)sample;
    (void)user;
    force[0] = force[1] = force[2] = 0.0;
}

/* 1: its loop can be stepped. -1: no loop can be made. */
static int can_step(knurl_device *device) {
    knurl_loop_desc desc;
    knurl_loop *loop = NULL;
    knurl_loop_desc_init(&desc, sizeof desc);
    desc.device = device;
    desc.force_callback = no_force;
    if (knurl_loop_create(&desc, &loop)) {
        return -1;
    }
    const int can = knurl_loop_step(loop, 0) == KNURL_OK;
    knurl_loop_destroy(loop);
    return can;
}

static int begin(trial *t, uint64_t seed) {
    const double ramp_s = trial_ramp(t);
    t->simulated_ns = 1000000000;
    t->j->sees_writes = 0;
    t->j->slack = 0;
    t->j->seed = seed;
    t->j->after = "the begin";
    t->device = t->on->open(seed, t->j);
    if (!t->device) {
        return 1;
    }
    knurl_device_info_init(&t->info, sizeof t->info);
    (void)knurl_device_get_info(t->device, &t->info);
    const int can = can_step(t->device);
    t->is_stepped = can == 1;
    t->j->slack = t->is_stepped ? 0 : SLACK;
    t->rate = t->is_stepped ? trial_rate(t) : 1000.0;
    t->slew_rate = trial_uniform(t) < 0.7 ? KNURL_DEFAULT : 200.0 * t->info.max_force * trial_between(t, 0.1, 1.5);
    judge_begin(t->j, &t->info, t->rate, ramp_s, t->slew_rate);
    if (can < 0 || trial_make_scene(t) || trial_make_loop(t, ramp_s)) {
        knurl_loop_destroy(t->loop);
        knurl_scene_destroy(t->scene);
        t->on->close(t->device);
        return 1;
    }
    return 0;
}

int trial_run(const subject *on, uint64_t seed, judge *j, uint64_t *tick_count) {
    trial t;
    memset(&t, 0, sizeof t);
    t.on = on;
    t.j = j;
    t.random = seed * 0x9e3779b97f4a7c15u + 0x2545f4914f6cdd1du;
    if (begin(&t, seed)) {
        return 1;
    }
    for (int i = 0; i < ACTS; i++) {
        trial_act(&t);
        trial_advance(&t, (int)trial_scale(&t, 1.0, 100.0) - 1);
    }
    trial_prove_alive(&t);
    trial_end(&t);
    *tick_count += t.ticks;
    return 0;
}

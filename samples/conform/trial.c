/* A trial from its begin to one of its ends. Read trial_run(), at the end, first. SPDX-License-Identifier: MIT */
#include "trial.h"

#include <string.h>

#define ACTS  60 /* of a trial */
#define SLACK 6  /* ticks by which a haptic thread's judgement may be late */

/* The clock of loops that are stepped, so that motors cool by the same time in every run. */
static int64_t simulated_ns;

static int64_t simulated_now(void *user) {
    (void)user;
    return simulated_ns;
}

static void simulated_sleep(int64_t deadline_ns, void *user) {
    (void)user;
    simulated_ns = deadline_ns;
}

static void on_tick(const knurl_tick_output *output, void *user) {
    trial *t = user;
    knurl_hip_contact contacts[KNURL_CONTACTS_MAX];
    if (!judge_try(t->j)) {
        t->skipped = 1;
        return;
    }
    if (t->skipped) {
        judge_pass_over(t->j, output);
    } else {
        judge_tick(t->j, output, contacts, knurl_scene_get_contacts(t->scene, 0, contacts, KNURL_CONTACTS_MAX));
    }
    t->skipped = 0;
    judge_leave(t->j);
}

static void no_force(uint64_t tick, const knurl_device_sample *sample, double force[3], void *user) {
    (void)tick;
    (void)sample;
    (void)user;
    force[0] = force[1] = force[2] = 0.0;
}

/* 1: its loop can be stepped. -1: it has none. */
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

int trial_make_loop(trial *t, double ramp_s) {
    static const knurl_clock simulated = {simulated_now, simulated_sleep, NULL};
    knurl_loop_desc desc;
    knurl_loop_desc_init(&desc, sizeof desc);
    desc.device = t->device;
    desc.scene = t->scene;
    desc.tick_callback = on_tick;
    desc.user = t;
    desc.update_rate_hz = t->rate;
    desc.ramp_s = ramp_s;
    desc.reconnect = 1;
    desc.clock = t->is_stepped ? &simulated : NULL;
    return knurl_loop_create(&desc, &t->loop) || (!t->is_stepped && knurl_loop_start(t->loop));
}

void trial_advance(trial *t, int ticks) {
    t->ticks += (uint64_t)ticks;
    if (!t->is_stepped) {
        (void)knurl_loop_wait(t->loop, ticks / t->rate);
        return;
    }
    (void)knurl_loop_step(t->loop, (uint64_t)ticks);
    simulated_ns += (int64_t)(ticks * 1e9 / t->rate);
    const uint64_t reads = t->on->reads ? t->on->reads() : (uint64_t)ticks;
    if (reads < (uint64_t)ticks) {
        judge_miss(t->j, (uint64_t)ticks - reads);
    }
}

static int begin(trial *t, uint64_t seed) {
    const double ramp_s = trial_ramp(t);
    simulated_ns = 1000000000;
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
    t->slew_rate = trial_uniform(t) < 0.7 ? 0.0 : 200.0 * t->info.max_force * trial_between(t, 0.1, 1.5);
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

/* The loop of a trial and its ticks. SPDX-License-Identifier: MIT */
#include "trial.h"

/* The clock of stepped loops, so that motors cool equally in every run. */
static int64_t simulated_now(void *user) {
    const trial *t = user;
    return t->simulated_ns;
}

static void simulated_sleep(int64_t deadline_ns, void *user) {
    trial *t = user;
    t->simulated_ns = deadline_ns;
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

int trial_make_loop(trial *t, double ramp_s) {
    const knurl_clock simulated = {simulated_now, simulated_sleep, t};
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
    t->simulated_ns += (int64_t)(ticks * 1e9 / t->rate);
    const uint64_t reads = t->on->reads ? t->on->reads() : (uint64_t)ticks;
    if (reads < (uint64_t)ticks) {
        judge_miss(t->j, (uint64_t)ticks - reads);
    }
}

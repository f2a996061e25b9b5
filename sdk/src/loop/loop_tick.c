/* A loop's tick: device -> scene or callback -> device. Read knurl_loop_tick(), at the end, first.
 * SPDX-License-Identifier: MIT */
#include "loop/loop_internal.h"

#include "base/atomic.h"
#include "base/vec3.h"
#include "scene/scene.h"

#include <math.h>
#include <string.h>

void knurl_loop_init(knurl_loop *loop, const knurl_hip_facts *facts) {
    loop->gain = loop->added.gain = loop->added.gain_now = 1.0;
    loop->game_was_alive = loop->wanted = 1;
    loop->per_force = 1.0 / (facts->continuous_force * facts->continuous_force);
    loop->last = loop->hip ? &loop->hip->last : &loop->own;
    knurl_last_stage_init(&loop->own, loop->desc.protections, 0.0, facts);
}

static void report(knurl_loop *loop, int32_t code, double value) {
    knurl_port_report(loop->desc.device, code, value);
}

/* 1 if the game calls knurl_loop_heartbeat() often enough, no heartbeat is needed, or the loop is paused. */
static int is_game_alive(knurl_loop *loop, int paused) {
    if (loop->desc.heartbeat_s == 0.0 || paused) {
        loop->since_heartbeat = 0;
        loop->game_was_alive = 1;
        return 1;
    }
    const uint64_t heartbeats = knurl_load_relaxed(&loop->heartbeats);
    loop->since_heartbeat = heartbeats == loop->heartbeats_seen ? loop->since_heartbeat + 1 : 0;
    loop->heartbeats_seen = heartbeats;
    const double silence = (double)loop->since_heartbeat / loop->desc.update_rate_hz;
    const int is_alive = silence <= loop->desc.heartbeat_s;
    if (loop->game_was_alive && !is_alive) {
        report(loop, KNURL_FAULT_HEARTBEAT, silence);
    }
    loop->game_was_alive = is_alive;
    return is_alive;
}

/* The largest change of a gain in a tick. */
static double gain_step(const knurl_loop *loop) {
    return 1.0 / (1.0 + loop->desc.ramp_s * loop->desc.update_rate_hz);
}

/* The gain on this tick's force: after a halt it ramps up again; while paused or without a heartbeat it ramps down.
 * Sets loop->was_halted. A halt lasts until this tick's force is written, because an I/O thread may still hold an older
 * one. */
static double next_gain(knurl_loop *loop, int paused) {
    const double step = gain_step(loop);
    loop->was_halted = knurl_device_is_halted(loop->desc.device) != 0;
    const int was_down = loop->was_halted || !loop->wanted;
    double gain = loop->was_halted || (paused && loop->ticks == 0) ? 0.0 : loop->gain;
    loop->wanted = is_game_alive(loop, paused) && !paused;
    if (was_down && loop->wanted && loop->ticks > 0 && knurl_device_may_resume(loop->desc.device)) {
        report(loop, KNURL_FAULT_RESUMED, 0.0);
    }
    if (!loop->wanted) {
        gain = knurl_loop_approach(gain, 0.0, step);
    }
    loop->gain = loop->wanted ? knurl_loop_approach(gain, 1.0, step) : gain;
    return gain;
}

/* Calls the force callback, and limits its force like a scene's. */
static void call_back(knurl_loop *loop, const knurl_device_sample *sample, double game_gain, int paused) {
    uint32_t flags = 0;
    memset(loop->force, 0, sizeof loop->force);
    loop->desc.force_callback(loop->ticks, sample, loop->force, loop->desc.user);
    const double gain = game_gain * next_gain(loop, paused); /* a halt may have come meanwhile */
    const double length = knurl_last_stage_limit(loop->last, gain, 0.0, loop->force, &flags);
    if (!knurl_is_finite(length)) {
        memset(loop->force, 0, sizeof loop->force);
        knurl_last_stage_note(loop->last, loop->force);
    } else if (flags & KNURL_TICK_HEAT) {
        knurl_count_up(&loop->heat_ticks);
    }
}

/* Computes the force to send, from the scene or from the caller. */
static void make_force(knurl_loop *loop, const knurl_device_sample *sample, knurl_tick_output *output) {
    const int paused = knurl_load_acquire(&loop->paused) != 0;
    knurl_loop_added *a = &loop->added;
    const double game_gain =
        knurl_load_double(&a->gain) == a->gain_now ? a->gain_now : knurl_loop_move_gain(a, gain_step(loop));
    if (loop->desc.scene) {
        knurl_tick_input input;
        knurl_added_force sum;
        memset(&input, 0, sizeof input);
        memcpy(input.position, sample->position, sizeof input.position);
        const double gain = next_gain(loop, paused);
        input.attenuation = 1.0 - gain * game_gain;
        input.paused = paused && gain == 0.0;
        const knurl_added_force *added = knurl_loop_adds(a) ? knurl_loop_next_added(a, &sum) : NULL;
        knurl_hip_tick(loop->desc.scene, loop->hip, &input, added, output);
        vec3_copy(output->device_force, loop->force);
        vec3_copy(output->force, loop->scene_force);
    } else {
        call_back(loop, sample, game_gain, paused);
    }
}

/* Runs a cycle without a position: the force is 0, and the next tick counts as the first. Returns 0 if the loop must
 * end. */
static int run_without_position(knurl_loop *loop, knurl_result why) {
    knurl_count_up(&loop->absences);
    knurl_count_up(&loop->cycles);
    (void)knurl_loop_move_gain(&loop->added, gain_step(loop)); /* else a gain set meanwhile would start late */
    knurl_store_relaxed(&loop->absent, 1u);
    memset(loop->force, 0, sizeof loop->force);
    memset(loop->scene_force, 0, sizeof loop->scene_force);
    if (!loop->desc.scene) {
        knurl_last_stage_note(loop->last, loop->force);
    } else {
        knurl_tick_input input;
        knurl_tick_output output;
        memset(&input, 0, sizeof input);
        input.absent = 1;
        knurl_hip_tick(loop->desc.scene, loop->hip, &input, NULL, &output);
    }
    knurl_loop_tell_heat(loop);
    if (why == KNURL_ERROR_DEVICE_NOT_READY) {
        (void)knurl_device_write(loop->desc.device, loop->force); /* zero, for drivers without an I/O thread */
        return 1;
    }
    loop->served_at = 0; /* a reopened device may call from another thread: do not measure lateness across the gap */
    loop->is_lost = why != KNURL_ERROR_DEVICE_LOST || !loop->desc.reconnect;
    return !loop->is_lost;
}

/* Bookkeeping comes after the write, so that it does not delay the force. */
int knurl_loop_tick(knurl_loop *loop) {
    knurl_device_sample sample;
    knurl_tick_output output;
    knurl_result result = knurl_device_read(loop->desc.device, &sample);
    if (result) {
        return run_without_position(loop, result);
    }
    memset(&output, 0, sizeof output);
    const int64_t before = loop->clock.now_ns(loop->clock.user);
    make_force(loop, &sample, &output);
    const int64_t after = loop->clock.now_ns(loop->clock.user);
    result = knurl_device_write(loop->desc.device, loop->force);
    if (loop->was_halted && result == KNURL_OK) {
        knurl_device_release_halt(loop->desc.device);
    }
    knurl_loop_tell_heat(loop);
    knurl_histogram_add(&loop->tick_ns, after - before);
    if (loop->desc.scene && loop->desc.tick_callback) {
        loop->desc.tick_callback(&output, loop->desc.user);
    }
    knurl_store_relaxed(&loop->absent, 0u);
    knurl_count_up(&loop->ticks);
    knurl_count_up(&loop->cycles);
    return result == KNURL_OK || run_without_position(loop, result);
}

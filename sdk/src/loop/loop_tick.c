/* A loop's tick: device -> scene or callback -> device. Read knurl_loop_tick() first.
 * SPDX-License-Identifier: MIT */
#include "base/atomic.h"
#include "base/rule.h"
#include "base/vec3.h"
#include "loop/loop_internal.h"
#include "scene/scene.h"

#include <math.h>
#include <string.h>

void knurl_loop_init(knurl_loop *loop, const knurl_hip_facts *facts) {
    loop->haptic.gain = loop->shared.added.gain = loop->shared.added.gain_now = 1.0;
    loop->haptic.game_was_alive = loop->haptic.wanted = 1;
    loop->haptic.per_force = 1.0 / (facts->continuous_force * facts->continuous_force);
    loop->haptic.last = loop->shared.hip ? &loop->shared.hip->last : &loop->haptic.own;
    knurl_last_stage_init(&loop->haptic.own, loop->shared.desc.protections, KNURL_DEFAULT, facts);
}

static void report(knurl_loop *loop, int32_t code, double value) {
    knurl_port_report(loop->shared.desc.device, code, value);
}

/* 1 if the game calls knurl_loop_heartbeat() often enough, no heartbeat is needed, or the loop is paused. */
static int is_game_alive(knurl_loop *loop, int paused) {
    if (loop->shared.desc.heartbeat_s == 0.0 || paused) {
        loop->haptic.since_heartbeat = 0;
        loop->haptic.game_was_alive = 1;
        return 1;
    }
    const uint64_t heartbeats = knurl_load_relaxed(&loop->shared.heartbeats);
    loop->haptic.since_heartbeat = heartbeats == loop->haptic.heartbeats_seen ? loop->haptic.since_heartbeat + 1 : 0;
    loop->haptic.heartbeats_seen = heartbeats;
    const double silence = (double)loop->haptic.since_heartbeat / loop->shared.desc.update_rate_hz;
    const int is_alive = silence <= loop->shared.desc.heartbeat_s;
    if (loop->haptic.game_was_alive && !is_alive) {
        report(loop, KNURL_FAULT_HEARTBEAT, silence);
    }
    loop->haptic.game_was_alive = is_alive;
    return is_alive;
}

/* The largest change of a gain in a tick. */
static double gain_step(const knurl_loop *loop) {
    return 1.0 / (1.0 + loop->shared.desc.ramp_s * loop->shared.desc.update_rate_hz);
}

/* The gain on this tick's force: after a halt it ramps up again; while paused or without a heartbeat it ramps down.
 * Sets loop->haptic.was_halted. A halt lasts until this tick's force is written, because an I/O thread may still hold
 * an older one. */
static double next_gain(knurl_loop *loop, int paused) {
    const double step = gain_step(loop);
    loop->haptic.was_halted = knurl_port_is_halted(loop->shared.desc.device) != 0;
    const int was_down = loop->haptic.was_halted || !loop->haptic.wanted;
    double gain = loop->haptic.was_halted || (paused && loop->shared.ticks == 0) ? 0.0 : loop->haptic.gain;
    loop->haptic.wanted = is_game_alive(loop, paused) && !paused;
    if (was_down && loop->haptic.wanted && loop->shared.ticks > 0 &&
        knurl_device_may_resume(loop->shared.desc.device)) {
        report(loop, KNURL_FAULT_RESUMED, 0.0);
    }
    if (!loop->haptic.wanted) {
        gain = knurl_loop_approach(gain, 0.0, step);
    }
    loop->haptic.gain = loop->haptic.wanted ? knurl_loop_approach(gain, 1.0, step) : gain;
    return gain;
}

/* Calls the force callback, and limits its force like a scene's. */
static void call_back(knurl_loop *loop, const knurl_device_sample *sample, double game_gain, int paused) {
    uint32_t flags = 0;
    memset(loop->haptic.force, 0, sizeof loop->haptic.force);
    loop->shared.desc.force_callback(loop->shared.ticks, sample, loop->haptic.force, loop->shared.desc.user);
    const double gain = game_gain * next_gain(loop, paused); /* a halt may have come meanwhile */
    loop->haptic.torque_gain = gain;
    const double length = knurl_last_stage_limit(loop->haptic.last, gain, 0.0, loop->haptic.force, &flags);
    if (!knurl_is_finite(length)) {
        loop->haptic.torque_gain = 0.0;
        memset(loop->haptic.force, 0, sizeof loop->haptic.force);
        knurl_last_stage_note(loop->haptic.last, loop->haptic.force);
    } else if (flags & KNURL_TICK_HEAT) {
        knurl_count_up(&loop->shared.heat_ticks);
    }
}

/* Computes the force to send, from the scene or from the caller. */
static void make_force(knurl_loop *loop, const knurl_device_sample *sample, knurl_tick_output *output) {
    const int paused = knurl_load_acquire(&loop->shared.paused) != 0;
    knurl_loop_added *a = &loop->shared.added;
    const double game_gain =
        knurl_load_double(&a->gain) == a->gain_now ? a->gain_now : knurl_loop_move_gain(a, gain_step(loop));
    if (loop->shared.desc.scene) {
        knurl_tick_input input;
        knurl_added_force sum;
        memset(&input, 0, sizeof input);
        memcpy(input.position, sample->position, sizeof input.position);
        const double gain = next_gain(loop, paused);
        input.attenuation = 1.0 - gain * game_gain;
        input.paused = paused && gain == 0.0;
        const knurl_added_force *added = knurl_loop_adds(a) ? knurl_loop_next_added(a, &sum) : NULL;
        knurl_hip_tick(loop->shared.desc.scene, loop->shared.hip, &input, added, output);
        loop->haptic.torque_gain = output->flags & KNURL_TICK_NOT_FINITE ? 0.0 : gain * game_gain;
        vec3_copy(output->device_force, loop->haptic.force);
        vec3_copy(output->force, loop->haptic.scene_force);
    } else {
        call_back(loop, sample, game_gain, paused);
    }
}

/* Hands the torque and the gripper's force to the device, for the write that follows. */
static void make_torque(knurl_loop *loop, const knurl_device_sample *sample) {
    memset(&loop->haptic.torque, 0, sizeof loop->haptic.torque);
    loop->shared.desc.torque_callback(loop->shared.ticks, sample, &loop->haptic.torque, loop->shared.desc.user);
    knurl_port_set_torque(loop->shared.desc.device, loop->haptic.torque_gain, &loop->haptic.torque);
}

/* Runs a cycle without a position: the force is 0, and the next tick counts as the first. Returns 0 if the loop must
 * end. */
static int run_without_position(knurl_loop *loop, knurl_result why) {
    knurl_count_up(&loop->shared.absences);
    knurl_count_up(&loop->shared.cycles);
    (void)knurl_loop_move_gain(&loop->shared.added, gain_step(loop)); /* else a gain set meanwhile would start late */
    knurl_store_relaxed(&loop->shared.absent, 1u);
    memset(loop->haptic.force, 0, sizeof loop->haptic.force);
    memset(loop->haptic.scene_force, 0, sizeof loop->haptic.scene_force);
    memset(&loop->haptic.torque, 0, sizeof loop->haptic.torque);
    if (!loop->shared.desc.scene) {
        knurl_last_stage_note(loop->haptic.last, loop->haptic.force);
    } else {
        knurl_tick_input input;
        knurl_tick_output output;
        memset(&input, 0, sizeof input);
        input.absent = 1;
        knurl_hip_tick(loop->shared.desc.scene, loop->shared.hip, &input, NULL, &output);
    }
    knurl_loop_tell_heat(loop);
    if (why == KNURL_ERROR_DEVICE_NOT_READY) {
        /* zero, for drivers without an I/O thread */
        (void)knurl_device_write(loop->shared.desc.device, loop->haptic.force);
        return 1;
    }
    /* a reopened device may call from another thread: do not measure lateness across the gap */
    loop->haptic.served_at = 0;
    loop->haptic.is_lost = why != KNURL_ERROR_DEVICE_LOST || !loop->shared.desc.reconnect;
    return !loop->haptic.is_lost;
}

/* Bookkeeping comes after the write, so that it does not delay the force. */
int knurl_loop_tick(knurl_loop *loop) {
    KNURL_RULE(HAPTIC, NULL); /* destroying the loop, or its scene, is allowed meanwhile */
    knurl_device_sample sample;
    knurl_tick_output output;
    knurl_result result = knurl_device_read(loop->shared.desc.device, &sample);
    if (result) {
        return run_without_position(loop, result);
    }
    memset(&output, 0, sizeof output);
    const int64_t before = loop->shared.clock.now_ns(loop->shared.clock.user);
    make_force(loop, &sample, &output);
    if (loop->shared.desc.torque_callback) {
        make_torque(loop, &sample);
    }
    const int64_t after = loop->shared.clock.now_ns(loop->shared.clock.user);
    result = knurl_device_write(loop->shared.desc.device, loop->haptic.force);
    if (loop->haptic.was_halted && result == KNURL_OK) {
        knurl_port_release_halt(loop->shared.desc.device);
    }
    knurl_loop_tell_heat(loop);
    knurl_histogram_add(&loop->shared.tick_ns, after - before);
    if (loop->shared.desc.scene && loop->shared.desc.tick_callback) {
        loop->shared.desc.tick_callback(&output, loop->shared.desc.user);
    }
    knurl_store_relaxed(&loop->shared.absent, 0u);
    knurl_count_up(&loop->shared.ticks);
    knurl_count_up(&loop->shared.cycles);
    return result == KNURL_OK || run_without_position(loop, result);
}

/* --- heat of the motors --- */

void knurl_loop_tell_heat(knurl_loop *loop) {
    knurl_store_double(&loop->shared.theta, loop->haptic.last->heat.square * loop->haptic.per_force);
}

void knurl_loop_begin_heat(knurl_loop *loop) {
    const knurl_motor_heat *motors = knurl_port_motors(loop->shared.desc.device);
    knurl_motor_heat_recall(loop->shared.desc.device);
    loop->haptic.last->heat.square = motors->square;
    if (motors->now == loop->shared.clock.now_ns && motors->user == loop->shared.clock.user) { /* the same clock */
        const double since = 1e-9 * (double)(loop->shared.clock.now_ns(loop->shared.clock.user) - motors->at);
        knurl_heat_hold(&loop->haptic.last->heat, 0.0, fmax(0.0, since) * loop->shared.desc.update_rate_hz);
    }
    knurl_loop_tell_heat(loop);
}

void knurl_loop_end_heat(knurl_loop *loop) {
    knurl_motor_heat *motors = knurl_port_motors(loop->shared.desc.device);
    motors->square = loop->haptic.last->heat.square;
    motors->at = loop->shared.clock.now_ns(loop->shared.clock.user);
    motors->now = loop->shared.clock.now_ns;
    motors->user = loop->shared.clock.user;
}

void knurl_loop_pass_time(knurl_loop *loop, int64_t now) {
    const double periods = 1e-9 * (double)(now - loop->haptic.cycle_at) * loop->shared.desc.update_rate_hz;
    const double missed = loop->haptic.cycle_at ? periods - 1.0 : 0.0;
    loop->haptic.cycle_at = now;
    if (missed < 1.0) {
        return;
    }
    const int halted = knurl_port_is_halted(loop->shared.desc.device) != 0;
    const double force2 = halted ? 0.0 : vec3_dot(loop->haptic.force, loop->haptic.force);
    knurl_heat_hold(&loop->haptic.last->heat, force2, missed);
    knurl_loop_tell_heat(loop);
}

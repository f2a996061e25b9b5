/* A cycle of the loop: device -> tick -> device. Read run_tick() first. SPDX-License-Identifier: MIT */
#include "loop/loop_internal.h"

#include "base/atomic.h"
#include "base/vec3.h"
#include "scene/scene.h"

#include <math.h>
#include <string.h>

/* A cycle that comes later than this has a gap before it. The watchdog waits as long by default. */
#define GAP_NS 50000000

static void report(knurl_loop *loop, int32_t code, double value) {
    knurl_port_report(loop->desc.device, code, value);
}

/* 1 while the game calls knurl_loop_heartbeat() often enough, or need not. A pause counts as alive. */
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

/* How far a gain may go in a tick. */
static double gain_step(const knurl_loop *loop) {
    return 1.0 / (1.0 + loop->desc.ramp_s * loop->desc.update_rate_hz);
}

/* The gain on this tick's force: after a halt it ramps up again; while paused or without a heartbeat it ramps down.
 * loop->was_halted: 1 where the device was halted. The halt lasts until this tick's force is written, because an I/O
 * thread may still hold an older one. */
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
        gain = fmax(0.0, gain - step);
    }
    loop->gain = loop->wanted ? fmin(1.0, gain + step) : gain;
    return gain;
}

/* Calls the caller's function and limits its force to what the motors can do now, before any ramp. */
static void call_back(knurl_loop *loop, const knurl_device_sample *sample) {
    memset(loop->force, 0, sizeof loop->force);
    loop->desc.force_callback(loop->ticks, sample, loop->force, loop->desc.user);
    const double length = vec3_length(loop->force);
    const double most = fmin(loop->max_force, knurl_heat_limit(&loop->heat));
    if (!(length <= most)) {
        const double share = knurl_is_finite(length) ? most / length : 0.0;
        if (most < loop->max_force && share > 0.0) {
            knurl_count_up(&loop->heat_ticks);
        }
        for (int axis = 0; axis < 3; axis++) {
            loop->force[axis] = share > 0.0 ? share * loop->force[axis] : 0.0;
        }
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
        /* on an error its force is 0 */
        (void)knurl_hip_tick(loop->desc.scene, loop->desc.hip, &input, added, output);
        vec3_copy(output->device_force, loop->force);
        vec3_copy(output->force, loop->scene_force);
    } else {
        call_back(loop, sample);
        vec3_scale(game_gain * next_gain(loop, paused), loop->force, loop->force);
    }
    knurl_loop_add_heat(loop, 1.0);
}

/* Runs a cycle without a position: the force is 0, and the next tick counts as the first. Returns 0 where the loop must
 * end. */
static int run_without_position(knurl_loop *loop, knurl_result why) {
    knurl_count_up(&loop->absences);
    knurl_count_up(&loop->cycles);
    knurl_store_relaxed(&loop->absent, 1u);
    loop->has_position = 0;
    memset(loop->force, 0, sizeof loop->force);
    memset(loop->scene_force, 0, sizeof loop->scene_force);
    knurl_loop_add_heat(loop, 0.0);
    if (loop->desc.scene) {
        knurl_tick_input input;
        knurl_tick_output output;
        memset(&input, 0, sizeof input);
        input.absent = 1;
        (void)knurl_hip_tick(loop->desc.scene, loop->desc.hip, &input, NULL, &output);
    }
    if (why == KNURL_ERROR_DEVICE_NOT_READY) {
        (void)knurl_device_write(loop->desc.device, loop->force); /* zero; for drivers without a thread that would write
                                                                     it */
        return 1;
    }
    loop->served_at = 0; /* a device that comes back may call from another thread: no lateness is measured across the
                            gap */
    loop->is_lost = why != KNURL_ERROR_DEVICE_LOST || !loop->desc.reconnect;
    return !loop->is_lost;
}

/* One tick. Returns 0 when the device is lost. */
static int run_tick(knurl_loop *loop) {
    knurl_device_sample sample;
    knurl_tick_output output;
    knurl_result result = knurl_device_read(loop->desc.device, &sample);
    if (result) {
        return run_without_position(loop, result);
    }
    memset(&output, 0, sizeof output);
    vec3_copy(sample.position, loop->position);
    loop->has_position = 1;
    const int64_t before = loop->clock.now_ns(loop->clock.user);
    make_force(loop, &sample, &output);
    knurl_histogram_add(&loop->tick_ns, loop->clock.now_ns(loop->clock.user) - before);
    if (loop->desc.scene && loop->desc.tick_callback) {
        loop->desc.tick_callback(&output, loop->desc.user);
    }
    knurl_store_relaxed(&loop->absent, 0u);
    knurl_count_up(&loop->ticks);
    knurl_count_up(&loop->cycles);
    result = knurl_device_write(loop->desc.device, loop->force);
    if (loop->was_halted && result == KNURL_OK) {
        knurl_device_release_halt(loop->desc.device);
    }
    return result == KNURL_OK || run_without_position(loop, result);
}

int knurl_loop_is_abandoned(const knurl_loop *loop) {
    return knurl_device_is_closed(loop->desc.device) ||
           (loop->desc.scene && knurl_scene_is_destroyed(loop->desc.scene));
}

int knurl_loop_at_end(const knurl_loop *loop) {
    return knurl_load_acquire(&loop->stop_requested) ||
           (loop->desc.tick_limit > 0 && knurl_load_relaxed(&loop->ticks) >= loop->desc.tick_limit) ||
           knurl_loop_is_abandoned(loop);
}

static uint64_t ramp_steps(const knurl_loop *loop) {
    return (uint64_t)(loop->desc.ramp_s * loop->desc.update_rate_hz);
}

/* Publishes a force that was sent without a tick. */
static void tell_force(knurl_loop *loop, double gain, double force[3]) {
    double scene_force[3];
    vec3_scale(gain, loop->force, force);
    vec3_scale(gain, loop->scene_force, scene_force);
    knurl_loop_add_heat(loop, gain);
    if (loop->desc.scene) {
        knurl_scene_publish_force(loop->desc.scene, loop->desc.hip, scene_force, force);
    }
}

void knurl_loop_publish_zero_force(knurl_loop *loop) {
    double force[3];
    tell_force(loop, 0.0, force);
}

/* One step of the ramp from the latest force to zero. Reads the device too, which some drivers need before a write.
 * Returns 0 after the last. */
static int ramp_down(knurl_loop *loop) {
    const uint64_t steps = ramp_steps(loop);
    if (loop->ramp_step >= steps) {
        return 0;
    }
    double gain = 1.0 - (double)++loop->ramp_step / (double)steps;
    double force[3];
    knurl_device_sample sample;
    const knurl_result result = knurl_device_read(loop->desc.device, &sample);
    gain = result || knurl_device_is_halted(loop->desc.device) ? 0.0 : gain;
    tell_force(loop, gain, force);
    if (result || knurl_device_write(loop->desc.device, force)) {
        loop->ramp_step = steps; /* no answer: no ramp */
    }
    knurl_count_up(&loop->cycles);
    return loop->ramp_step < steps;
}

int knurl_loop_cycle(knurl_loop *loop) {
    if (knurl_loop_is_abandoned(loop)) {
        return 0; /* at once, without a ramp */
    }
    return knurl_loop_at_end(loop) ? ramp_down(loop) : run_tick(loop);
}

void knurl_loop_end(knurl_loop *loop, int32_t state) {
    static const double none[3] = {0.0, 0.0, 0.0};
    knurl_device *device = loop->desc.device;
    knurl_device_halt(device);
    knurl_loop_publish_zero_force(loop);
    knurl_loop_end_heat(loop);
    if (knurl_port_may_hold_force(device)) { /* else it might hold its last force */
        (void)knurl_device_write(device, none);
    }
    knurl_store_release(&loop->state, state);
}

/* Runs a tick and discards its result, so that the real one finds its code and data in the cache. Only in cycles that
 * are not late, before the device is read. */
static void run_dry_tick(knurl_loop *loop) {
    if (!loop->desc.dry_ticks || !loop->desc.scene || loop->desc.clock || !loop->has_position ||
        knurl_load_relaxed(&loop->paused) || knurl_loop_at_end(loop)) {
        return;
    }
    const int64_t before = loop->clock.now_ns(loop->clock.user);
    knurl_hip_dry_tick(loop->desc.scene, loop->desc.hip, &loop->scratch, loop->position);
    knurl_histogram_add(&loop->dry_tick_ns, loop->clock.now_ns(loop->clock.user) - before);
}

/* After a gap hand and device may be anywhere: no force until a tick has read them, then the ramp. Not where the device
 * or the watchdog has halted meanwhile, and reported it. */
static void zero_after_gap(knurl_loop *loop, int64_t late) {
    knurl_device *device = loop->desc.device;
    if (late > GAP_NS && !loop->was_halted && !knurl_device_is_halted(device) && !knurl_port_is_lost(device)) {
        knurl_device_halt(device);
        report(loop, KNURL_FAULT_GAP, 1e-9 * (double)late);
    }
}

/* Records that a cycle began `late` ns after its deadline, except in the ramp at the end. */
static void note_lateness(knurl_loop *loop, int64_t late, int overrun) {
    zero_after_gap(loop, late);
    if (overrun && !knurl_port_is_lost(loop->desc.device)) {        /* reconnecting resets this check */
        knurl_port_add_gap(loop->desc.device, 1e-9 * (double)late); /* the hand moved on meanwhile */
    }
    if (knurl_loop_at_end(loop)) {
        return;
    }
    knurl_histogram_add(&loop->jitter_ns, late);
    if (overrun) {
        knurl_count_up(&loop->overruns);
        if (!loop->was_overrun) {
            report(loop, KNURL_FAULT_OVERRUN, 1e-9 * (double)late);
        }
    }
    loop->was_overrun = overrun;
}

static int32_t state_at_end(const knurl_loop *loop) {
    return loop->is_lost ? KNURL_LOOP_LOST : KNURL_LOOP_DONE;
}

void knurl_loop_haptic_thread(void *argument) {
    knurl_loop *loop = argument;
    uintptr_t stack = 0;
    int overrun;
    (void)knurl_error_message(); /* allocates this thread's storage now */
    knurl_store_release(&loop->haptic_thread, knurl_system_thread_id());
    knurl_store_relaxed(&loop->realtime, (uint32_t)knurl_system_make_realtime());
    knurl_store_relaxed(&loop->stack_locked, (uint32_t)knurl_system_lock_stack(&stack));
    knurl_pace_start(&loop->pace, &loop->clock, loop->desc.update_rate_hz);
    while (!knurl_loop_at_end(loop) || ramp_steps(loop) > loop->ramp_step) {
        const int64_t late = knurl_pace_wait(&loop->pace, &overrun);
        knurl_loop_pass_time(loop, loop->pace.woke_at);
        note_lateness(loop, late, overrun);
        if (!overrun) {
            run_dry_tick(loop);
        }
        if (!knurl_loop_cycle(loop)) {
            break;
        }
    }
    knurl_loop_end(loop, state_at_end(loop));
    knurl_system_unlock_stack(stack);
}

uint32_t knurl_loop_serve(void *argument) {
    knurl_loop *loop = argument;
    const double period = 1e9 / loop->desc.update_rate_hz;
    knurl_store_release(&loop->is_served, 1u); /* before the device can be found lost */
    const int64_t now = loop->clock.now_ns(loop->clock.user);
    if (loop->served_at == 0) {
        (void)knurl_error_message(); /* as on a haptic thread of ours */
        knurl_store_release(&loop->haptic_thread, knurl_system_thread_id());
    } else {
        const double late = fmax(0.0, (double)(now - loop->served_at) - period);
        note_lateness(loop, (int64_t)late, late > 0.5 * period);
        if (late <= 0.5 * period) {
            run_dry_tick(loop);
        }
    }
    loop->served_at = now;
    knurl_loop_pass_time(loop, now);
    if (knurl_loop_cycle(loop)) {
        knurl_store_release(&loop->is_served, 0u);
        return 1;
    }
    knurl_loop_end(loop, state_at_end(loop)); /* the loop may be gone now */
    return 0;
}

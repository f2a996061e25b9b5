/* A loop's cycles, on a thread of its own or the device's: lateness, gaps, and the ramp at the end.
 * SPDX-License-Identifier: MIT */
#include "base/atomic.h"
#include "base/rule.h"
#include "base/vec3.h"
#include "loop/loop_internal.h"
#include "scene/scene.h"

#include <math.h>

/* A cycle later than this comes after a gap. Equal to the watchdog's default. */
#define GAP_NS 50000000

int knurl_loop_is_abandoned(const knurl_loop *loop) {
    return knurl_device_is_closed(loop->shared.desc.device) ||
           (loop->shared.desc.scene && knurl_scene_is_destroyed(loop->shared.desc.scene));
}

int knurl_loop_at_end(const knurl_loop *loop) {
    return knurl_load_acquire(&loop->shared.stop_requested) ||
           (loop->shared.desc.tick_limit > 0 &&
            knurl_load_relaxed(&loop->shared.ticks) >= loop->shared.desc.tick_limit) ||
           knurl_loop_is_abandoned(loop);
}

static uint64_t ramp_steps(const knurl_loop *loop) {
    return (uint64_t)(loop->shared.desc.ramp_s * loop->shared.desc.update_rate_hz);
}

/* Publishes a force sent without a tick. */
static void tell_force(knurl_loop *loop, double gain, double force[3]) {
    double scene_force[3];
    vec3_scale(gain, loop->haptic.force, force);
    vec3_scale(gain, loop->haptic.scene_force, scene_force);
    if (loop->shared.desc.scene) {
        knurl_scene_publish_force(loop->shared.desc.scene, loop->shared.desc.hip, scene_force, force);
    } else {
        knurl_last_stage_note(loop->haptic.last, force);
    }
    knurl_loop_tell_heat(loop);
}

void knurl_loop_publish_zero_force(knurl_loop *loop) {
    double force[3];
    tell_force(loop, 0.0, force);
}

/* One step of the ramp from the last force to zero. Reads the device too, because some drivers need that before a
 * write. Returns 0 after the last step. */
static int ramp_down(knurl_loop *loop) {
    KNURL_RULE(HAPTIC, NULL); /* as in knurl_loop_tick() */
    const uint64_t steps = ramp_steps(loop);
    if (loop->haptic.ramp_step >= steps) {
        return 0;
    }
    double gain = 1.0 - (double)++loop->haptic.ramp_step / (double)steps;
    double force[3];
    knurl_device_sample sample;
    const knurl_result result = knurl_device_read(loop->shared.desc.device, &sample);
    gain = result || knurl_port_is_halted(loop->shared.desc.device) ? 0.0 : gain;
    tell_force(loop, gain, force);
    knurl_port_set_torque(loop->shared.desc.device, gain * loop->haptic.torque_gain, &loop->haptic.torque);
    if (result || knurl_device_write(loop->shared.desc.device, force)) {
        loop->haptic.ramp_step = steps; /* the device does not answer: skip the ramp */
    }
    knurl_count_up(&loop->shared.cycles);
    return loop->haptic.ramp_step < steps;
}

int knurl_loop_cycle(knurl_loop *loop) {
    if (knurl_loop_is_abandoned(loop)) {
        return 0; /* end at once, without a ramp */
    }
    return knurl_loop_at_end(loop) ? ramp_down(loop) : knurl_loop_tick(loop);
}

void knurl_loop_end(knurl_loop *loop, int32_t state) {
    KNURL_RULE(HAPTIC, NULL);
    static const double none[3] = {0.0, 0.0, 0.0};
    knurl_device *device = loop->shared.desc.device;
    knurl_device_halt(device);
    knurl_loop_publish_zero_force(loop);
    knurl_loop_end_heat(loop);
    if (knurl_port_may_hold_force(device)) { /* otherwise it might keep playing its last force */
        (void)knurl_device_write(device, none);
    }
    knurl_store_release(&loop->shared.state, state);
}

/* After a gap the handle may be anywhere: no force until a tick has read its position, then the ramp. Does nothing if
 * the device or the watchdog has halted meanwhile, and reported it. */
static void zero_after_gap(knurl_loop *loop, int64_t late) {
    knurl_device *device = loop->shared.desc.device;
    if (late > GAP_NS && !loop->haptic.was_halted && !knurl_port_is_halted(device) && !knurl_port_is_lost(device)) {
        knurl_device_halt(device);
        knurl_port_report(device, KNURL_FAULT_GAP, 1e-9 * (double)late);
    }
}

/* Records that a cycle began `late` ns after its deadline, except in the ramp at the end. */
static void note_lateness(knurl_loop *loop, int64_t late, int overrun) {
    zero_after_gap(loop, late);
    if (overrun && !knurl_port_is_lost(loop->shared.desc.device)) {        /* reconnecting resets this check */
        knurl_port_add_gap(loop->shared.desc.device, 1e-9 * (double)late); /* the hand kept moving meanwhile */
    }
    if (knurl_loop_at_end(loop)) {
        return;
    }
    knurl_histogram_add(&loop->shared.jitter_ns, late);
    if (overrun) {
        knurl_count_up(&loop->shared.overruns);
        if (!loop->haptic.was_overrun) {
            knurl_port_report(loop->shared.desc.device, KNURL_FAULT_OVERRUN, 1e-9 * (double)late);
        }
    }
    loop->haptic.was_overrun = overrun;
}

static void start_pace(knurl_pace *pace, const knurl_clock *clock, double rate) {
    pace->clock = *clock;
    pace->period_ns = 1e9 / rate;
    pace->start_ns = clock->now_ns(clock->user);
    pace->cycle = 0;
}

/* Sleeps until the next deadline. Returns the lateness of the wake-up, ns; *overrun: 1 if that is more than half a
 * period. Missed periods are skipped. */
static int64_t wait_for_period(knurl_pace *pace, int *overrun) {
    pace->cycle++;
    const int64_t deadline = pace->start_ns + (int64_t)((double)pace->cycle * pace->period_ns); /* no drift at 3 kHz */
    pace->clock.sleep_until_ns(deadline, pace->clock.user);
    pace->woke_at = pace->clock.now_ns(pace->clock.user);
    const int64_t late = pace->woke_at - deadline;
    *overrun = (double)late > 0.5 * pace->period_ns;
    if ((double)late > pace->period_ns) {
        pace->cycle += (uint64_t)((double)late / pace->period_ns);
    }
    return late;
}

static int32_t state_at_end(const knurl_loop *loop) {
    return loop->haptic.is_lost ? KNURL_LOOP_LOST : KNURL_LOOP_DONE;
}

void knurl_loop_haptic_thread(void *argument) {
    knurl_loop *loop = argument;
    uintptr_t stack = 0;
    int overrun;
    (void)knurl_error_message(); /* allocates this thread's storage now */
    knurl_store_release(&loop->shared.haptic_thread, knurl_system_thread_id());
    knurl_device_enter_thread(loop->shared.desc.device);
    knurl_store_relaxed(&loop->shared.realtime, (uint32_t)knurl_system_make_realtime());
    knurl_store_relaxed(&loop->shared.stack_locked, (uint32_t)knurl_system_lock_stack(&stack));
    start_pace(&loop->haptic.pace, &loop->shared.clock, loop->shared.desc.update_rate_hz);
    while (!knurl_loop_at_end(loop) || ramp_steps(loop) > loop->haptic.ramp_step) {
        const int64_t late = wait_for_period(&loop->haptic.pace, &overrun);
        knurl_loop_pass_time(loop, loop->haptic.pace.woke_at);
        note_lateness(loop, late, overrun);
        if (!knurl_loop_cycle(loop)) {
            break;
        }
    }
    knurl_loop_end(loop, state_at_end(loop));
    knurl_system_unlock_stack(stack);
}

uint32_t knurl_loop_serve(void *argument) {
    knurl_loop *loop = argument;
    const double period = 1e9 / loop->shared.desc.update_rate_hz;
    knurl_store_release(&loop->shared.is_served, 1u); /* before the watchdog can declare the device lost */
    const int64_t now = loop->shared.clock.now_ns(loop->shared.clock.user);
    if (loop->haptic.served_at == 0) {
        (void)knurl_error_message(); /* as in knurl_loop_haptic_thread() */
        knurl_store_release(&loop->shared.haptic_thread, knurl_system_thread_id());
        knurl_device_enter_thread(loop->shared.desc.device);
        knurl_store_relaxed(&loop->shared.realtime, (uint32_t)knurl_system_make_realtime());
    } else {
        const double late = fmax(0.0, (double)(now - loop->haptic.served_at) - period);
        note_lateness(loop, (int64_t)late, late > 0.5 * period);
    }
    loop->haptic.served_at = now;
    knurl_loop_pass_time(loop, now);
    if (knurl_loop_cycle(loop)) {
        knurl_store_release(&loop->shared.is_served, 0u);
        return 1;
    }
    knurl_loop_end(loop, state_at_end(loop)); /* the loop may be gone now */
    return 0;
}

/* The loop: device -> tick -> device, in real time on a thread of its own or step by step. Read run_tick() first.
 * SPDX-License-Identifier: MIT */
#include "loop/loop_internal.h"

#include "base/atomic.h"
#include "base/base.h"
#include "base/vec3.h"
#include "scene/scene_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A tick needs some kilobytes; callbacks get the rest. */
#define STACK_BYTES ((size_t)256 * 1024)

static int64_t system_now(void *user) {
    (void)user;
    return knurl_system_now_ns();
}

static void system_sleep(int64_t deadline_ns, void *user) {
    (void)user;
    knurl_system_sleep_until_ns(deadline_ns);
}

static int is_running(const knurl_loop *loop) {
    return knurl_load_acquire(&loop->state) == KNURL_LOOP_RUNNING;
}

/* The force of this tick, in device axes, from the scene or from the caller. */
static void make_force(knurl_loop *loop, const knurl_device_sample *sample, knurl_tick_output *output) {
    if (loop->desc.scene) {
        knurl_tick_input input;
        memset(&input, 0, sizeof input);
        memcpy(input.position, sample->position, sizeof input.position);
        (void)knurl_scene_tick(loop->desc.scene, loop->desc.hip, &input, output); /* on an error its force is 0 */
        memcpy(loop->force, output->device_force, sizeof loop->force);
    } else {
        memset(loop->force, 0, sizeof loop->force);
        loop->desc.force_callback(loop->ticks, sample, loop->force, loop->desc.user);
    }
    const double length = vec3_length(loop->force); /* ramps go from and to what the motors can play */
    const double most = fmin(loop->max_force, knurl_heat_limit(&loop->heat));
    if (!(length <= most)) {
        const double share = isfinite(length) ? most / length : 0.0;
        if (most < loop->max_force && share > 0.0) {
            knurl_count_up(&loop->heats);
        }
        for (int axis = 0; axis < 3; axis++) {
            loop->force[axis] = share > 0.0 ? share * loop->force[axis] : 0.0;
            output->device_force[axis] *= share;
            output->force[axis] *= share;
        }
    }
    if (!loop->desc.scene) {
        knurl_heat_add(&loop->heat, vec3_dot(loop->force, loop->force));
        knurl_store_double(&loop->theta, loop->heat.theta);
    }
}

/* After the watchdog let go of the motors, the force climbs back over the ramp. */
static void apply_gain(knurl_loop *loop, knurl_tick_output *output) {
    if (knurl_device_is_halted(loop->desc.device)) {
        knurl_device_release_halt(loop->desc.device);
        loop->gain = 0.0;
    }
    for (int axis = 0; axis < 3 && loop->gain < 1.0; axis++) {
        loop->force[axis] *= loop->gain;
        output->device_force[axis] *= loop->gain;
        output->force[axis] *= loop->gain;
    }
    loop->gain = fmin(1.0, loop->gain + 1.0 / (1.0 + loop->desc.ramp_s * loop->desc.update_rate_hz));
}

/* One tick. Returns 0 when the device is lost. */
static int run_tick(knurl_loop *loop) {
    knurl_device_sample sample;
    knurl_tick_output output;
    if (knurl_device_read(loop->desc.device, &sample)) {
        return 0;
    }
    memset(&output, 0, sizeof output);
    const int64_t before = loop->clock.now_ns(loop->clock.user);
    make_force(loop, &sample, &output);
    knurl_histogram_add(&loop->tick_ns, loop->clock.now_ns(loop->clock.user) - before);
    apply_gain(loop, &output);
    if (loop->desc.scene && loop->desc.tick_callback) {
        loop->desc.tick_callback(&output, loop->desc.user);
    }
    knurl_count_up(&loop->ticks);
    knurl_count_up(&loop->beats);
    return knurl_device_write(loop->desc.device, loop->force) == KNURL_OK;
}

static int at_end(const knurl_loop *loop) {
    return knurl_load_acquire(&loop->stop_requested) ||
           (loop->desc.tick_limit > 0 && loop->ticks >= loop->desc.tick_limit);
}

/* From the latest force down to none. The device is still read: it may need that to write. */
static void ramp_down(knurl_loop *loop, int paced) {
    const uint64_t steps = (uint64_t)(loop->desc.ramp_s * loop->desc.update_rate_hz);
    for (uint64_t i = 1; i <= steps; i++) {
        const double gain = 1.0 - (double)i / (double)steps;
        const double force[3] = {gain * loop->force[0], gain * loop->force[1], gain * loop->force[2]};
        knurl_device_sample sample;
        int overrun;
        if (paced) {
            (void)knurl_pace_wait(&loop->pace, &overrun);
        }
        if (knurl_device_read(loop->desc.device, &sample) || knurl_device_write(loop->desc.device, force)) {
            break;
        }
        knurl_count_up(&loop->beats);
    }
    knurl_device_halt(loop->desc.device);
}

static void end(knurl_loop *loop, int32_t state, int paced) {
    if (state == KNURL_LOOP_DONE) {
        ramp_down(loop, paced);
    } else {
        knurl_device_halt(loop->desc.device); /* what does not answer cannot be ramped down */
    }
    knurl_store_release(&loop->state, state);
}

static void haptic_thread(void *argument) {
    knurl_loop *loop = argument;
    int32_t state = KNURL_LOOP_DONE;
    uintptr_t stack = 0;
    knurl_store_release(&loop->haptic_thread, knurl_system_thread_id());
    knurl_store_relaxed(&loop->realtime, (uint32_t)knurl_system_make_realtime());
    knurl_store_relaxed(&loop->stack_locked, (uint32_t)knurl_system_lock_stack(&stack));
    knurl_pace_start(&loop->pace, &loop->clock, loop->desc.update_rate_hz);
    while (!at_end(loop)) {
        int overrun;
        knurl_histogram_add(&loop->jitter_ns, knurl_pace_wait(&loop->pace, &overrun));
        if (overrun) {
            knurl_count_up(&loop->overruns);
        }
        if (!run_tick(loop)) {
            state = KNURL_LOOP_LOST;
            break;
        }
    }
    end(loop, state, 1);
    knurl_system_unlock_stack(stack);
}

/* Lets go of the motors when no tick has been done for too long: a device holds its last force for ever. */
static void watchdog_thread(void *argument) {
    knurl_loop *loop = argument;
    const int64_t limit = (int64_t)(loop->desc.watchdog_s * 1e9);
    const int64_t nap = limit > 80000000 ? 20000000
                        : limit < 400000 ? 100000
                                         : limit / 4; /* nobody waits long for it */
    int64_t seen_at = knurl_system_now_ns();
    uint64_t seen = 0;
    while (is_running(loop)) {
        knurl_system_sleep_until_ns(knurl_system_now_ns() + nap);
        const uint64_t beats = knurl_load_relaxed(&loop->beats);
        const int64_t now = knurl_system_now_ns();
        if (beats != seen) {
            seen = beats;
            seen_at = now;
        } else if (now - seen_at > limit && is_running(loop) && !knurl_device_is_halted(loop->desc.device)) {
            knurl_device_halt(loop->desc.device);
            knurl_count_up(&loop->watchdogs);
        }
    }
}

static knurl_result check(const knurl_loop_desc *d) {
    if (!d->device) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "knurl_loop_desc.device: expected a device, found null");
    }
    if (!d->scene == !d->force_callback) {
        return knurl_fail(KNURL_ERROR_ARGUMENT,
                          "knurl_loop_desc: expected exactly one of scene and force_callback, found %s",
                          d->scene ? "both" : "none");
    }
    if (d->scene && !d->scene->committed) {
        return knurl_fail(KNURL_ERROR_STATE, "knurl_loop_desc.scene: expected a committed scene, found an open one");
    }
    if (!(d->update_rate_hz >= KNURL_UPDATE_RATE_MIN && d->update_rate_hz <= KNURL_UPDATE_RATE_MAX)) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "update rate: expected %g to %g Hz, found %g Hz", KNURL_UPDATE_RATE_MIN,
                          KNURL_UPDATE_RATE_MAX, d->update_rate_hz);
    }
    if (!(d->ramp_s >= 0.0 && d->ramp_s <= 1.0) || !(d->watchdog_s >= 0.0 && d->watchdog_s <= 10.0)) {
        return knurl_fail(KNURL_ERROR_ARGUMENT,
                          "knurl_loop_desc: expected ramp_s 0 to 1 s and watchdog_s 0 to 10 s, found %g "
                          "and %g",
                          d->ramp_s, d->watchdog_s);
    }
    if (d->unguarded & ~(uint32_t)KNURL_UNGUARDED_HEAT) {
        return knurl_fail(KNURL_ERROR_ARGUMENT,
                          "knurl_loop_desc.unguarded: expected 0 or KNURL_UNGUARDED_HEAT (a scene's HIP has its own), "
                          "found %#x",
                          (unsigned)d->unguarded);
    }
    if (d->clock && (!d->clock->now_ns || !d->clock->sleep_until_ns)) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "knurl_loop_desc.clock: expected both functions, found null");
    }
    return KNURL_OK;
}

void knurl_loop_desc_init(knurl_loop_desc *desc, uint32_t size) {
    const knurl_loop_desc defaults = {.update_rate_hz = 1000.0, .ramp_s = 0.02, .watchdog_s = 0.05};
    knurl_desc_write(&defaults, sizeof defaults, desc, size);
}

void knurl_loop_stats_init(knurl_loop_stats *stats, uint32_t size) {
    const knurl_loop_stats defaults = {0};
    knurl_desc_write(&defaults, sizeof defaults, stats, size);
}

/* What the device is. A driver that tells no heat_time tells nothing of friction and heat at all. */
static knurl_result adopt(const knurl_loop_desc *d, knurl_hip_facts *facts) {
    knurl_device_info info;
    knurl_device_info_init(&info, sizeof info);
    const knurl_result result = knurl_device_get_info(d->device, &info);
    *facts = knurl_touch;
    facts->rate = d->update_rate_hz;
    facts->resolution = info.resolution;
    facts->max_force = info.max_force;
    facts->delay = info.delay;
    if (info.heat_time > 0.0) {
        facts->continuous_force = info.continuous_force;
        facts->heat_time = info.heat_time;
        facts->viscous = info.viscous;
        facts->max_stiffness = info.max_stiffness;
    }
    return result || !d->scene ? result : knurl_scene_adopt_device(d->scene, d->hip, facts);
}

knurl_result knurl_loop_create(const knurl_loop_desc *desc, knurl_loop **loop) {
    static const knurl_clock system_clock = {system_now, system_sleep, NULL};
    knurl_loop_desc d;
    knurl_loop_desc_init(&d, sizeof d);
    knurl_result result = knurl_desc_read("knurl_loop_desc", desc, &d, sizeof d);
    result = result ? result : check(&d);
    knurl_hip_facts facts;
    result = result ? result : adopt(&d, &facts);
    result = result ? result : knurl_device_start(d.device, d.update_rate_hz);
    if (result) {
        return result;
    }
    knurl_loop *made = calloc(1, sizeof *made);
    if (!made) {
        return knurl_fail(KNURL_ERROR_MEMORY, "loop: could not get %u bytes", (unsigned)sizeof *made);
    }
    made->desc = d;
    made->clock = d.clock ? *d.clock : system_clock;
    made->gain = 1.0;
    made->max_force = facts.max_force;
    if (d.unguarded & KNURL_UNGUARDED_HEAT) {
        facts.continuous_force = HUGE_VAL;
    }
    knurl_heat_init(&made->heat, &facts);
    knurl_device_release_halt(d.device);
    *loop = made;
    return KNURL_OK;
}

knurl_result knurl_loop_start(knurl_loop *loop) {
    if (knurl_load_acquire(&loop->state) != KNURL_LOOP_IDLE) {
        return knurl_fail(KNURL_ERROR_STATE, "loop: expected one that never ran, found one that runs or has run");
    }
    const int scene_locked = !loop->desc.scene || knurl_scene_lock_memory(loop->desc.scene) == KNURL_OK;
    loop->scene_locked = (uint32_t)(knurl_system_lock_memory(loop, sizeof *loop) && scene_locked);
    knurl_store_release(&loop->threaded, 1u);
    knurl_store_release(&loop->state, KNURL_LOOP_RUNNING);
    loop->thread = knurl_system_start_thread(haptic_thread, loop, STACK_BYTES);
    if (!loop->thread) {
        knurl_store_release(&loop->state, KNURL_LOOP_IDLE);
        return knurl_fail(KNURL_ERROR_SYSTEM, "loop: the system refused another thread");
    }
    if (loop->desc.watchdog_s > 0.0 && !loop->desc.clock) { /* with a clock of the caller's, real time says nothing */
        loop->watchdog = knurl_system_start_thread(watchdog_thread, loop, STACK_BYTES);
        if (!loop->watchdog) {
            knurl_loop_stop(loop);
            return knurl_fail(KNURL_ERROR_SYSTEM, "loop: the system refused a thread for the watchdog");
        }
    }
    return KNURL_OK;
}

knurl_result knurl_loop_step(knurl_loop *loop, uint64_t ticks) {
    if (loop->thread) {
        return knurl_fail(KNURL_ERROR_STATE, "loop: it has a haptic thread and cannot be stepped");
    }
    if (loop->state == KNURL_LOOP_IDLE) {
        knurl_store_release(&loop->state, KNURL_LOOP_RUNNING);
        knurl_store_release(&loop->haptic_thread, knurl_system_thread_id());
    }
    for (uint64_t i = 0; i < ticks && is_running(loop) && !at_end(loop); i++) {
        if (!run_tick(loop)) {
            end(loop, KNURL_LOOP_LOST, 0);
        }
    }
    if (is_running(loop) && at_end(loop)) {
        end(loop, KNURL_LOOP_DONE, 0);
    }
    return KNURL_OK;
}

void knurl_loop_request_stop(knurl_loop *loop) {
    knurl_store_release(&loop->stop_requested, 1u);
}

void knurl_loop_stop(knurl_loop *loop) {
    knurl_loop_request_stop(loop);
    if (knurl_load_acquire(&loop->haptic_thread) == knurl_system_thread_id()) {
        return; /* from a callback: the loop ends when this returns */
    }
    while (knurl_load_acquire(&loop->threaded) && is_running(loop)) { /* one that is stepped ends in its next step */
        (void)knurl_loop_wait(loop, 1.0);
    }
}

uint32_t knurl_loop_wait(knurl_loop *loop, double seconds) {
    const int64_t until = knurl_system_now_ns() + (int64_t)(fmin(fmax(seconds, 0.0), 1e9) * 1e9);
    while (is_running(loop) && knurl_system_now_ns() < until) {
        knurl_system_sleep_until_ns(knurl_system_now_ns() + 500000);
    }
    return !is_running(loop);
}

void knurl_loop_destroy(knurl_loop *loop) {
    if (!loop) {
        return;
    }
    if (loop->thread) {
        knurl_loop_stop(loop);
        knurl_system_join_thread(loop->thread);
    } else if (is_running(loop)) {
        end(loop, KNURL_LOOP_DONE, 0);
    }
    if (loop->watchdog) {
        knurl_system_join_thread(loop->watchdog);
    }
    knurl_system_unlock_memory(loop, sizeof *loop);
    free(loop);
}

static knurl_percentiles percentiles_of(const knurl_histogram *histogram) {
    const double max = (double)knurl_load_relaxed(&histogram->max); /* a bucket's middle may lie above it */
    const knurl_percentiles made = {fmin(max, knurl_histogram_percentile(histogram, 0.5)),
                                    fmin(max, knurl_histogram_percentile(histogram, 0.99)), max};
    return made;
}

knurl_result knurl_loop_get_stats(const knurl_loop *loop, knurl_loop_stats *stats) {
    knurl_loop_stats made;
    memset(&made, 0, sizeof made);
    made.state = knurl_load_acquire(&loop->state);
    made.ticks = knurl_load_relaxed(&loop->ticks);
    made.overruns = knurl_load_relaxed(&loop->overruns);
    made.watchdogs = knurl_load_relaxed(&loop->watchdogs);
    made.realtime = knurl_load_relaxed(&loop->realtime);
    made.memory_locked = loop->scene_locked && knurl_load_relaxed(&loop->stack_locked);
    made.tick_ns = percentiles_of(&loop->tick_ns);
    made.jitter_ns = percentiles_of(&loop->jitter_ns);
    made.heats = knurl_load_relaxed(&loop->heats);
    made.heat = knurl_load_double(&loop->theta);
    return knurl_desc_return("knurl_loop_stats", &made, sizeof made, stats);
}

/* The loop's public functions: create, start, step, stop, statistics. For a cycle see cycle.c.
 * SPDX-License-Identifier: MIT */
#include "loop/loop_internal.h"

#include "base/atomic.h"
#include "base/base.h"
#include "base/number.h"
#include "base/rule.h"
#include "scene/scene.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static int64_t system_now(void *user) {
    (void)user;
    return knurl_system_now_ns();
}

static void system_sleep(int64_t deadline_ns, void *user) {
    (void)user;
    knurl_system_sleep_until_ns(deadline_ns);
}

/* A forked child does not have the threads that could end the loop. */
static int is_running_here(const knurl_loop *loop) {
    return knurl_loop_is_running(loop) && knurl_load_relaxed(&loop->shared.process) == knurl_system_process_id();
}

static const knurl_field fields[] = {
    {"update_rate_hz", offsetof(knurl_loop_desc, update_rate_hz), {KNURL_RANGE_RATE, 0}},
    {"ramp_s", offsetof(knurl_loop_desc, ramp_s), {0.0, 1.0, "s", 0}},
    {"watchdog_s", offsetof(knurl_loop_desc, watchdog_s), {0.0, 10.0, "s", 0}},
    {"heartbeat_s", offsetof(knurl_loop_desc, heartbeat_s), {0.0, 3600.0, "s", 0}},
};

static knurl_result check(const knurl_loop_desc *d) {
    if (knurl_is_bad_handle(d->device, KNURL_HANDLE_DEVICE, "knurl_loop_desc.device") ||
        (d->scene && knurl_is_bad_handle(d->scene, KNURL_HANDLE_SCENE, "knurl_loop_desc.scene"))) {
        return KNURL_ERROR_ARGUMENT;
    }
    if (!d->scene == !d->force_callback) {
        return knurl_fail(KNURL_ERROR_ARGUMENT,
                          "knurl_loop_desc: expected exactly one of scene and force_callback, found %s",
                          d->scene ? "both" : "neither");
    }
    if (d->scene && !knurl_load_acquire(&d->scene->committed)) {
        return knurl_fail(KNURL_ERROR_STATE, "knurl_loop_desc.scene: expected a committed scene, found an open one");
    }
    const knurl_result result = knurl_fields_check("knurl_loop_desc", fields, sizeof fields / sizeof *fields, d);
    if (result) {
        return result;
    }
    if (d->protections & ~(uint32_t)(KNURL_PROTECT_HEAT | KNURL_PROTECT_SLEW)) {
        return knurl_fail(KNURL_ERROR_ARGUMENT,
                          "knurl_loop_desc.protections: expected bits of KNURL_PROTECT_HEAT and KNURL_PROTECT_SLEW (a "
                          "scene's HIP has its own), found %#x",
                          (unsigned)d->protections);
    }
    if (d->reconnect > 1) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "knurl_loop_desc.reconnect: expected 0 or 1, found %u",
                          (unsigned)d->reconnect);
    }
    if (d->clock && (!d->clock->now_ns || !d->clock->sleep_until_ns)) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "knurl_loop_desc.clock: expected both functions, found null");
    }
    return KNURL_OK;
}

void knurl_loop_desc_init(knurl_loop_desc *desc, uint32_t size) {
    const knurl_loop_desc defaults = {
        .update_rate_hz = 1000.0, .ramp_s = 0.02, .watchdog_s = 0.05, .protections = KNURL_PROTECT_HEAT};
    knurl_desc_write(&defaults, sizeof defaults, desc, size);
}

void knurl_loop_stats_init(knurl_loop_stats *stats, uint32_t size) {
    const knurl_loop_stats defaults = {0};
    knurl_desc_write(&defaults, sizeof defaults, stats, size);
}

/* Reads the device's properties and passes them to the scene. */
static knurl_result adopt(const knurl_loop_desc *d, knurl_hip_facts *facts) {
    knurl_device_info info;
    knurl_device_info_init(&info, sizeof info);
    const knurl_result result = knurl_device_get_info(d->device, &info);
    if (result) {
        return result;
    }
    const knurl_hip_facts made = {d->update_rate_hz, info.resolution, info.max_force, info.continuous_force,
                                  info.heat_time,    info.viscous,    info.delay,     info.max_stiffness};
    *facts = made;
    return d->scene ? knurl_scene_adopt_device(d->scene, d->hip, facts) : KNURL_OK;
}

/* Claims device and HIP for this loop. Errors: KNURL_ERROR_STATE, KNURL_ERROR_ARGUMENT (hip). */
static knurl_result claim(const knurl_loop_desc *d) {
    knurl_result result = knurl_device_claim(d->device);
    if (!result && d->scene) {
        result = knurl_scene_claim_hip(d->scene, d->hip);
        if (result) {
            knurl_device_release(d->device);
        }
    }
    return result;
}

/* Frees a device or scene that the host has closed or destroyed meanwhile. */
static void release(const knurl_loop_desc *d) {
    if (d->scene) {
        knurl_scene_release_hip(d->scene, d->hip);
    }
    knurl_device_release(d->device);
}

static knurl_result make(const knurl_loop_desc *d, const knurl_hip_facts *facts, knurl_loop **loop) {
    static const knurl_clock system_clock = {system_now, system_sleep, NULL};
    knurl_loop *made = calloc(1, sizeof *made);
    if (!made) {
        return knurl_fail(KNURL_ERROR_MEMORY, "loop: could not get %u bytes", (unsigned)sizeof *made);
    }
    made->handle = KNURL_HANDLE_LOOP;
    made->shared.process = knurl_system_process_id();
    made->shared.desc = *d;
    made->shared.clock = d->clock ? *d->clock : system_clock;
    made->shared.hip = d->scene ? &d->scene->hips[d->hip] : NULL;
    knurl_loop_init(made, facts);
    *loop = made;
    return KNURL_OK;
}

knurl_result knurl_loop_create(const knurl_loop_desc *desc, knurl_loop **loop) {
    KNURL_RULE(GAME, NULL);
    if (KNURL_IS_NULL(desc) || KNURL_IS_NULL(loop)) {
        return KNURL_ERROR_ARGUMENT;
    }
    knurl_loop_desc d;
    knurl_loop_desc_init(&d, sizeof d);
    knurl_result result = knurl_desc_read("knurl_loop_desc", desc, &d, sizeof d);
    result = result ? result : check(&d);
    result = result ? result : claim(&d);
    if (result) {
        return result;
    }
    knurl_hip_facts facts;
    knurl_loop *made = NULL;
    result = adopt(&d, &facts);
    result = result ? result : knurl_device_begin(d.device, d.update_rate_hz);
    result = result ? result : make(&d, &facts, &made);
    if (result) {
        release(&d);
        return result;
    }
    *loop = made;
    return KNURL_OK;
}

/* Starts the haptic thread, or uses the device's own. */
static knurl_result start_haptics(knurl_loop *loop) {
    knurl_device *device = loop->shared.desc.device;
    if (knurl_port_owns_thread(device)) {
        return knurl_port_serve(device, knurl_loop_serve, loop);
    }
    loop->game.thread = knurl_system_start_thread(knurl_loop_haptic_thread, loop, KNURL_LOOP_STACK_BYTES);
    return loop->game.thread ? KNURL_OK : knurl_fail(KNURL_ERROR_SYSTEM, "loop: the system refused another thread");
}

/* Returns 1 if the loop's own memory and its scene's are locked into RAM. */
static int lock_memory(knurl_loop *loop) {
    const int own = knurl_system_lock_memory(loop, sizeof *loop);
    const int scene = !loop->shared.desc.scene || knurl_scene_lock_memory(loop->shared.desc.scene) == KNURL_OK;
    return own && scene;
}

knurl_result knurl_loop_start(knurl_loop *loop) {
    KNURL_RULE(GAME, loop);
    if (KNURL_BAD_HANDLE(loop, LOOP)) {
        return KNURL_ERROR_ARGUMENT;
    }
    if (knurl_load_acquire(&loop->shared.state) != KNURL_LOOP_IDLE) {
        return knurl_fail(KNURL_ERROR_STATE, "loop: expected one that never ran, found one that runs or has run");
    }
    if (knurl_loop_is_abandoned(loop)) {
        return knurl_fail(KNURL_ERROR_STATE, "loop: its %s",
                          knurl_device_is_closed(loop->shared.desc.device) ? "device was closed"
                                                                           : "scene was destroyed");
    }
    knurl_store_relaxed(&loop->shared.scene_locked, (uint32_t)lock_memory(loop));
    knurl_device_claim_thread(loop->shared.desc.device);
    knurl_loop_begin_heat(loop);
    knurl_store_relaxed(&loop->shared.process, knurl_system_process_id());
    knurl_store_release(&loop->shared.threaded, 1u);
    knurl_store_release(&loop->shared.state, KNURL_LOOP_RUNNING);
    knurl_result result = knurl_loop_start_watchdog(loop); /* before the haptic thread: no force without a watchdog */
    result = result ? result : start_haptics(loop);
    if (result) {
        knurl_store_release(&loop->shared.state, KNURL_LOOP_IDLE);
        knurl_loop_end_watchdog(loop);
        knurl_store_release(&loop->shared.threaded, 0u);
    }
    return result;
}

/* Runs the ramp at the end on this thread. */
static void finish_stepping(knurl_loop *loop) {
    knurl_store_relaxed(&loop->shared.stepping, 1u);
    knurl_loop_request_stop(loop);
    while (knurl_loop_cycle(loop)) {}
    knurl_loop_end(loop, KNURL_LOOP_DONE);
}

/* 1 if called from inside the loop: from a callback of its haptic thread, or from its watchdog thread. */
static int is_inside(const knurl_loop *loop) {
    const uintptr_t here = knurl_system_thread_id();
    const int runs = knurl_loop_is_running(loop) &&
                     (knurl_load_acquire(&loop->shared.threaded) || knurl_load_relaxed(&loop->shared.stepping));
    return (runs && knurl_load_acquire(&loop->shared.haptic_thread) == here) ||
           knurl_load_acquire(&loop->shared.watchdog_thread) == here;
}

knurl_result knurl_loop_step(knurl_loop *loop, uint64_t ticks) {
    KNURL_RULE(GAME, loop);
    if (KNURL_BAD_HANDLE(loop, LOOP)) {
        return KNURL_ERROR_ARGUMENT;
    }
    knurl_device *device = loop->shared.desc.device;
    if (knurl_load_acquire(&loop->shared.threaded)) {
        return knurl_fail(KNURL_ERROR_STATE, "loop: it has a haptic thread and cannot be stepped");
    }
    if (!knurl_port_can_step(device)) {
        return knurl_fail(KNURL_ERROR_UNSUPPORTED, "loop: device '%s' runs in real time only and cannot be stepped",
                          knurl_port_uri(device));
    }
    if (loop->shared.state == KNURL_LOOP_IDLE) {
        knurl_loop_begin_heat(loop);
        knurl_store_release(&loop->shared.state, KNURL_LOOP_RUNNING);
        knurl_store_release(&loop->shared.haptic_thread, knurl_system_thread_id());
    }
    knurl_store_relaxed(&loop->shared.stepping, 1u);
    for (uint64_t i = 0; i < ticks && knurl_loop_is_running(loop) && !knurl_loop_at_end(loop); i++) {
        if (loop->shared.desc.reconnect && knurl_port_is_lost(device)) {
            (void)knurl_device_reopen(device);
        }
        if (!knurl_loop_cycle(loop)) {
            knurl_loop_end(loop, loop->haptic.is_lost ? KNURL_LOOP_LOST : KNURL_LOOP_DONE);
        }
    }
    if (knurl_loop_is_running(loop) && knurl_loop_at_end(loop)) {
        finish_stepping(loop);
    }
    knurl_store_relaxed(&loop->shared.stepping, 0u);
    return KNURL_OK;
}

void knurl_loop_request_stop(knurl_loop *loop) {
    if (KNURL_BAD_HANDLE(loop, LOOP)) {
        return;
    }
    knurl_store_release(&loop->shared.stop_requested, 1u);
}

void knurl_loop_pause(knurl_loop *loop) {
    if (KNURL_BAD_HANDLE(loop, LOOP)) {
        return;
    }
    knurl_store_release(&loop->shared.paused, 1u);
}

void knurl_loop_resume(knurl_loop *loop) {
    if (KNURL_BAD_HANDLE(loop, LOOP)) {
        return;
    }
    knurl_store_release(&loop->shared.paused, 0u);
}

void knurl_loop_heartbeat(knurl_loop *loop) {
    if (KNURL_BAD_HANDLE(loop, LOOP)) {
        return;
    }
    (void)__atomic_fetch_add(&loop->shared.heartbeats, 1, __ATOMIC_RELAXED);
}

void knurl_loop_stop(knurl_loop *loop) {
    if (KNURL_BAD_HANDLE(loop, LOOP)) {
        return;
    }
    knurl_loop_request_stop(loop);
    if (is_inside(loop)) {
        return; /* the loop ends when this returns */
    }
    /* a stepped loop ends in its next step */
    while (knurl_load_acquire(&loop->shared.threaded) && is_running_here(loop)) {
        (void)knurl_loop_wait(loop, 1.0);
    }
}

uint32_t knurl_loop_wait(knurl_loop *loop, double seconds) {
    KNURL_RULE(NOT_HAPTIC, loop);
    if (KNURL_BAD_HANDLE(loop, LOOP)) {
        return 1;
    }
    const int64_t until = knurl_system_now_ns() + (int64_t)(fmin(fmax(seconds, 0.0), 1e9) * 1e9);
    while (is_running_here(loop) && knurl_system_now_ns() < until) {
        knurl_system_sleep_until_ns(knurl_system_now_ns() + 500000);
    }
    return !is_running_here(loop);
}

void knurl_loop_destroy(knurl_loop *loop) {
    KNURL_RULE(END, loop);
    if (!loop || KNURL_BAD_HANDLE(loop, LOOP)) {
        return;
    }
    if (is_inside(loop)) { /* a loop's own thread can neither wait for its end nor free it */
        knurl_loop_request_stop(loop);
        return;
    }
    if (knurl_load_acquire(&loop->shared.threaded)) {
        knurl_loop_stop(loop);
        if (loop->game.thread) {
            knurl_system_join_thread(loop->game.thread);
        }
    } else if (knurl_loop_is_running(loop)) {
        finish_stepping(loop);
    }
    knurl_loop_end_watchdog(loop);
    knurl_system_unlock_memory(loop, sizeof *loop);
    release(&loop->shared.desc);
    knurl_handle_clear(&loop->handle);
    free(loop);
}

static knurl_percentiles percentiles_of(const knurl_histogram *histogram) {
    const double max = (double)knurl_load_relaxed(&histogram->max); /* the middle of its bucket may be larger */
    const knurl_percentiles made = {fmin(max, knurl_histogram_percentile(histogram, 0.5)),
                                    fmin(max, knurl_histogram_percentile(histogram, 0.99)), max};
    return made;
}

knurl_result knurl_loop_get_stats(const knurl_loop *loop, knurl_loop_stats *stats) {
    if (KNURL_BAD_HANDLE(loop, LOOP) || KNURL_IS_NULL(stats)) {
        return KNURL_ERROR_ARGUMENT;
    }
    knurl_loop_stats made;
    memset(&made, 0, sizeof made);
    made.state = knurl_load_acquire(&loop->shared.state);
    made.ticks = knurl_load_relaxed(&loop->shared.ticks);
    made.overruns = knurl_load_relaxed(&loop->shared.overruns);
    made.watchdog_trips = knurl_load_relaxed(&loop->shared.watchdog_trips);
    made.realtime = knurl_load_relaxed(&loop->shared.realtime);
    made.memory_locked =
        knurl_load_relaxed(&loop->shared.scene_locked) && knurl_load_relaxed(&loop->shared.stack_locked);
    made.tick_ns = percentiles_of(&loop->shared.tick_ns);
    made.jitter_ns = percentiles_of(&loop->shared.jitter_ns);
    made.heat_ticks = knurl_load_relaxed(&loop->shared.heat_ticks);
    made.heat = knurl_load_double(&loop->shared.theta);
    made.absences = knurl_load_relaxed(&loop->shared.absences);
    made.absent = knurl_load_relaxed(&loop->shared.absent);
    made.paused = knurl_load_relaxed(&loop->shared.paused);
    made.io_realtime = knurl_port_is_io_realtime(loop->shared.desc.device);
    return knurl_desc_return("knurl_loop_stats", &made, sizeof made, stats);
}

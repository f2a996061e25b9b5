/* A loop's watchdog thread: runs beside the haptic thread, zeroes the force if cycles stop (a device may keep playing
 * its last force), and reopens a lost device. SPDX-License-Identifier: MIT */
#include "loop/loop_internal.h"

#include "base/atomic.h"
#include "base/base.h"

/* Interval of attempts to reopen a lost device. */
#define RECONNECT_NS 250000000

/* A lost device with a servo thread makes no more calls if its last one is longer ago than this. */
#define LAST_CALL_NS 50000000

typedef struct watchdog {
    uint64_t seen;   /* cycles */
    int64_t seen_at; /* ns: when `seen` last changed */
    int64_t tried_at;
    uint64_t idle_cycles;
    double idle; /* s without a cycle, counted in naps, so that time in which the process was stopped does not count */
} watchdog;

static void watch(knurl_loop *loop, watchdog *k, int64_t now) {
    const int64_t limit = (int64_t)(loop->shared.desc.watchdog_s * 1e9);
    const uint64_t cycles = knurl_load_relaxed(&loop->shared.cycles);
    knurl_device *device = loop->shared.desc.device;
    if (cycles != k->seen || cycles == 0) { /* no force before the first */
        k->seen = cycles;
        k->seen_at = now;
    } else if (limit > 0 && !knurl_port_is_lost(device) && now - k->seen_at > limit && knurl_loop_is_running(loop) &&
               !knurl_port_is_halted(device)) {
        knurl_device_halt(device);
        knurl_port_report(device, KNURL_FAULT_WATCHDOG, 1e-9 * (double)(now - k->seen_at));
        knurl_count_up(&loop->shared.watchdog_trips);
    }
}

/* A device that owns the servo thread and has stopped calling is lost. Ticks cannot detect that, because they have
 * stopped. */
static void look_for_stall(knurl_loop *loop, watchdog *k, double nap) {
    knurl_device *device = loop->shared.desc.device;
    const uint64_t cycles = knurl_load_relaxed(&loop->shared.cycles);
    k->idle = cycles == k->idle_cycles && !knurl_port_is_lost(device) ? k->idle + nap : 0.0;
    k->idle_cycles = cycles;
    if (k->idle < KNURL_SERVE_GIVE_UP || !knurl_port_leave(device)) {
        return;
    }
    k->idle = 0.0;
    if (!knurl_loop_is_running(loop) || knurl_port_is_lost(device)) {
        return; /* its last call has ended the loop or found it lost */
    }
    knurl_device_halt(device);
    knurl_loop_publish_zero_force(loop);
    knurl_port_lose(device);
    if (!loop->shared.desc.reconnect) {
        knurl_loop_end(loop, KNURL_LOOP_LOST);
    }
}

static void look_for_device(knurl_loop *loop, watchdog *k, int64_t now) {
    if (!loop->shared.desc.reconnect || !knurl_port_is_lost(loop->shared.desc.device)) {
        return;
    }
    if (knurl_loop_at_end(loop) && knurl_port_owns_thread(loop->shared.desc.device)) {
        /* a lost device makes no more calls, but its last one may still be using the loop */
        if (!knurl_load_acquire(&loop->shared.is_served) && now - k->seen_at > LAST_CALL_NS) {
            knurl_loop_end(loop, KNURL_LOOP_DONE);
        }
    } else if (now - k->tried_at > RECONNECT_NS) {
        (void)knurl_device_reopen(loop->shared.desc.device);
        k->tried_at = k->seen_at = knurl_system_now_ns(); /* no cycle could run while reopening */
    }
}

static void watchdog_thread(void *argument) {
    knurl_loop *loop = argument;
    const int64_t limit = (int64_t)(loop->shared.desc.watchdog_s * 1e9);
    /* at most 20 ms, because knurl_loop_destroy() waits for this thread */
    const int64_t nap = limit > 80000000 || limit == 0 ? 20000000 : limit < 400000 ? 100000 : limit / 4;
    knurl_store_release(&loop->shared.watchdog_thread, knurl_system_thread_id());
    watchdog k = {0, knurl_system_now_ns(), 0, 0, 0.0};
    while (knurl_loop_is_running(loop)) {
        knurl_system_sleep_until_ns(knurl_system_now_ns() + nap);
        const int64_t now = knurl_system_now_ns();
        watch(loop, &k, now);
        look_for_stall(loop, &k, 1e-9 * (double)nap);
        look_for_device(loop, &k, now);
    }
}

knurl_result knurl_loop_start_watchdog(knurl_loop *loop) {
    const int is_needed = loop->shared.desc.watchdog_s > 0.0 || loop->shared.desc.reconnect ||
                          knurl_port_owns_thread(loop->shared.desc.device);
    if (!is_needed || loop->shared.desc.clock) { /* with the caller's clock, real time is meaningless */
        return KNURL_OK;
    }
    loop->game.watchdog = knurl_system_start_thread(watchdog_thread, loop, KNURL_LOOP_STACK_BYTES);
    return loop->game.watchdog ? KNURL_OK
                               : knurl_fail(KNURL_ERROR_SYSTEM, "loop: the system refused a thread for the watchdog");
}

void knurl_loop_end_watchdog(knurl_loop *loop) {
    if (loop->game.watchdog) {
        knurl_system_join_thread(loop->game.watchdog);
        loop->game.watchdog = NULL;
        knurl_store_release(&loop->shared.watchdog_thread, (uintptr_t)0);
    }
}

/* The stub library in a test: found by the driver through the environment, held and commanded from here.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_STUB_H
#define KNURL_TEST_STUB_H

#include "support/close.h"
#include "support/wait.h"

#include "base/system.h"
#include "device/touch/stub_hd.h"

#include <knurl/knurl.h>
#include <stdlib.h>

static struct {
    knurl_library *library;
    stub_set_function set;
    stub_ask_function ask;
    stub_limp_function limp_since;
    stub_turn_function turn;
    stub_reset_function reset;
    stub_use_time_function use_time;
} stub;

/** A group's setup: the driver finds the stub, and it stays loaded. */
static inline int stub_load(void **state) {
    char why[256];
    (void)state;
    stub.library = knurl_system_load_library(KNURL_TEST_STUB, why, sizeof why);
    if (!stub.library || !knurl_system_find_function(stub.library, "stub_set", &stub.set) ||
        !knurl_system_find_function(stub.library, "stub_ask", &stub.ask) ||
        !knurl_system_find_function(stub.library, "stub_limp_since", &stub.limp_since) ||
        !knurl_system_find_function(stub.library, "stub_turn", &stub.turn) ||
        !knurl_system_find_function(stub.library, "stub_reset", &stub.reset) ||
        !knurl_system_find_function(stub.library, "stub_use_time", &stub.use_time)) {
        print_error("%s: %s\n", KNURL_TEST_STUB, stub.library ? "not all functions are there" : why);
        return 1;
    }
    stub.use_time(&stub_program_time);
    return setenv("KNURL_HD_LIBRARY", KNURL_TEST_STUB, 1);
}

static inline int stub_unload(void **state) {
    (void)state;
    knurl_system_unload_library(stub.library);
    return 0;
}

/** A test's setup: as new, turned by hand. */
static inline int stub_by_hand(void **state) {
    (void)state;
    stub.reset();
    stub.set(0, STUB_BY_HAND, 1.0);
    return 0;
}

static inline knurl_device *stub_open(const char *uri) {
    knurl_device *device = NULL;
    if (knurl_device_open(uri, &device)) {
        fail_msg("%s: %s", uri, knurl_error_message());
    }
    return device;
}

/** A loop's callback: its force and position. */
typedef struct stub_push {
    double force[3]; /* written */
    double from[3];  /* m: the last position */
    uint64_t ticks;
    uint32_t buttons;
    double joints[8];
    uint32_t joint_count;
} stub_push;

static inline void stub_push_force(uint64_t tick, const knurl_device_sample *sample, double force[3], void *user) {
    stub_push *push = user;
    (void)tick;
    memcpy(force, push->force, sizeof push->force);
    memcpy(push->from, sample->position, sizeof push->from);
    push->buttons = sample->buttons;
    push->joint_count = sample->joint_count;
    memcpy(push->joints, sample->joints, sizeof push->joints);
    __atomic_fetch_add(&push->ticks, 1, __ATOMIC_RELAXED);
}

/** A loop that writes one force, without a watchdog, which turns by hand would set off. */
static inline knurl_loop_desc stub_loop_desc(knurl_device *device, stub_push *push) {
    knurl_loop_desc desc;
    knurl_loop_desc_init(&desc, sizeof desc);
    desc.device = device;
    desc.force_callback = stub_push_force;
    desc.user = push;
    desc.watchdog_s = 0.0;
    return desc;
}

static inline knurl_loop *stub_loop(const knurl_loop_desc *desc) {
    knurl_loop *loop = NULL;
    if (knurl_loop_create(desc, &loop) || knurl_loop_start(loop)) {
        fail_msg("%s", knurl_error_message());
    }
    return loop;
}

static inline int32_t stub_loop_state(const knurl_loop *loop) {
    knurl_loop_stats stats;
    knurl_loop_stats_init(&stats, sizeof stats);
    (void)knurl_loop_get_stats(loop, &stats);
    return stats.state;
}

/** Requests a manually turned loop to stop, turns it to its end and destroys it. */
static inline void stub_end_loop(knurl_loop *loop) {
    knurl_loop_request_stop(loop);
    for (int turn = 0; turn < 100 && stub_loop_state(loop) == KNURL_LOOP_RUNNING; turn++) {
        stub.turn(1);
    }
    assert_int_not_equal(stub_loop_state(loop), KNURL_LOOP_RUNNING);
    knurl_loop_destroy(loop);
}

static inline double told(void) {
    return stub.ask(STUB_DEFAULT, STUB_TOLD);
}

/** A device and a loop that writes one force to it. */
typedef struct stub_bench {
    knurl_device *device;
    stub_push push;
    knurl_loop *loop;
} stub_bench;

static stub_bench bench; /* stub_check() closes it */

static inline void stub_start(stub_bench *b, const char *uri, double force, uint32_t reconnect) {
    memset(b, 0, sizeof *b);
    b->push.force[1] = force;
    b->device = stub_open(uri);
    knurl_loop_desc desc = stub_loop_desc(b->device, &b->push);
    desc.reconnect = reconnect;
    b->loop = stub_loop(&desc);
}

/** On the default device, without reconnecting. */
static inline void start(double force) {
    stub_start(&bench, "touch", force, 0);
}

static inline void stub_close(stub_bench *b) {
    if (b->loop) {
        stub_end_loop(b->loop);
        assert_true(told() == 0.0 || device_status(b->device).lost); /* one that is lost cannot be told */
    }
    knurl_device_close(b->device);
    memset(b, 0, sizeof *b);
}

/** Ends a loop that is not turned by hand. */
static inline void stub_destroy_loop(stub_bench *b) {
    knurl_loop_destroy(b->loop);
    b->loop = NULL;
}

/** Ticks so far of a loop that runs. */
static inline uint64_t stub_ticks(const stub_bench *b) {
    return __atomic_load_n(&b->push.ticks, __ATOMIC_RELAXED);
}

/** A test's teardown: checks that all was closed and has no force, and that no call violated HD's rules. */
static inline int stub_check(void **state) {
    (void)state;
    stub_close(&bench);
    const double misuses = stub.ask(0, STUB_MISUSES);
    double left = stub.ask(0, STUB_RUNNING) + stub.ask(0, STUB_CALLBACKS);
    for (int device = STUB_DEFAULT; device <= STUB_RIGHT; device++) {
        left += stub.ask(device, STUB_INITIALISED) + stub.ask(device, STUB_TOLD);
    }
    if (misuses != 0.0 || left != 0.0) {
        print_error("%g calls that HD does not allow, %g things left behind\n", misuses, left);
        return 1;
    }
    return 0;
}

/** Removes all events. Returns the number of those with that code. */
static inline int stub_events(knurl_device *device, int32_t code, double *value) {
    knurl_device_event event;
    int count = 0;
    while (knurl_device_next_event(device, &event)) {
        if (event.code == code) {
            count++;
            if (value) {
                *value = event.value;
            }
        }
    }
    return count;
}

#endif

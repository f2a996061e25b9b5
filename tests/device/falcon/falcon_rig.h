/* A Falcon's driver over a simulated device, for tests: opens it, reads and writes as a loop does, counts its faults.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_FALCON_RIG_H
#define KNURL_TEST_FALCON_RIG_H

#include "support/close.h"
#include "support/wait.h"

#include "device/driver.h"
#include "device/port.h"
#include "falcon_fake.h"

#include <knurl/loop.h>
#include <stdio.h>

static falcon_fake fake;
static const double no_force[3] = {0.0, 0.0, 0.0};

static knurl_device *device;
static knurl_loop *running;

/* A test's setup: a fresh device on the bus, in a moving hand. */
static inline int begin(void **state) {
    (void)state;
    falcon_fake_init(&fake, NULL);
    return 0;
}

static inline int end(void **state) {
    (void)state;
    knurl_loop_destroy(running);
    running = NULL;
    knurl_device_close(device);
    device = NULL;
    falcon_fake_free(&fake);
    return fake.opens != fake.closes;
}

/* Another device, for a test's next case. */
static inline void restart(void) {
    assert_int_equal(end(NULL), 0);
    (void)begin(NULL);
}

static inline void open_with(const char *options) {
    const knurl_falcon_bus bus = falcon_fake_bus(&fake);
    char all[512];
    (void)snprintf(all, sizeof all, "%s%cmotors_known=1", options, options[0] ? '&' : '?');
    if (knurl_falcon_open_on(&bus, all, &device)) {
        fail_msg("%s", knurl_error_message());
    }
    knurl_device_register(device);
    assert_int_equal(knurl_device_start(device, 1000.0), KNURL_OK);
}

typedef struct outcome {
    int good, not_ready, lost;
    knurl_device_sample newest;
    double step; /* m: longest between two readings */
} outcome;

/* A loop without a scene: reads, writes `force`, for so many ms. */
static inline outcome run(int ms, const double force[3]) {
    outcome o;
    memset(&o, 0, sizeof o);
    int64_t next = knurl_system_now_ns();
    for (int i = 0; i < ms; i++) {
        knurl_device_sample sample;
        const knurl_result result = knurl_device_read(device, &sample);
        if (result == KNURL_OK) {
            for (int axis = 0; axis < 3 && o.good > 0; axis++) {
                o.step = fmax(o.step, fabs(sample.position[axis] - o.newest.position[axis]));
            }
            o.newest = sample;
            o.good++;
            (void)knurl_device_write(device, force);
        } else if (result == KNURL_ERROR_DEVICE_LOST) {
            o.lost++;
        } else {
            o.not_ready++;
            (void)knurl_device_write(device, no_force);
        }
        next += 1000000;
        knurl_system_sleep_until_ns(next);
    }
    return o;
}

/* Opened, and its first position has come: until then it is halted, as a loop would have it. */
static inline void open_ready_with(const char *options) {
    open_with(options);
    for (int i = 0; i < 1000 && run(1, no_force).good == 0; i++) {}
    knurl_port_release_halt(device);
}

static inline void open_ready(void) {
    open_ready_with("");
}

static int others; /* faults but the one that events_of() counted */

/* The count of a fault since the last call. */
static inline int events_of(int32_t code) {
    int count = 0;
    knurl_device_event event;
    others = 0;
    while (knurl_device_next_event(device, &event)) {
        count += event.code == code;
        others += event.code != code;
    }
    return count;
}

static inline int is_limp(void) {
    const falcon_sim sim = falcon_fake_look(&fake);
    return !sim.motors[0] && !sim.motors[1] && !sim.motors[2];
}

#endif

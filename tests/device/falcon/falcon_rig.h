/* A Falcon's driver over a simulated device, for tests: opens it, reads and writes as a loop does, counts its faults.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_FALCON_RIG_H
#define KNURL_TEST_FALCON_RIG_H

#include "support/close.h"

#include "device/driver.h"
#include "device/port.h"
#include "falcon_fake.h"

#include <knurl/loop.h>
#include <stdio.h>

static falcon_fake fake;
static const double no_force[3] = {0.0, 0.0, 0.0};

static knurl_device *opened; /* a failed test leaves these; begin() closes them */
static knurl_loop *running;

/* A fresh device on the bus, in a moving hand. */
static inline void begin(void) {
    knurl_loop_destroy(running);
    running = NULL;
    knurl_device_close(opened);
    opened = NULL;
    falcon_fake_init(&fake, NULL);
}

static inline knurl_device *open_with(const char *options) {
    const knurl_falcon_bus bus = falcon_fake_bus(&fake);
    char all[512];
    (void)snprintf(all, sizeof all, "%s%cmotors_known=1", options, options[0] ? '&' : '?');
    if (knurl_falcon_open_on(&bus, all, &opened)) {
        fail_msg("%s", knurl_error_message());
    }
    knurl_device_register(opened);
    assert_int_equal(knurl_device_start(opened, 1000.0), KNURL_OK);
    return opened;
}

static inline knurl_device *open_fake(void) {
    return open_with("");
}

static inline void close_fake(knurl_device *device) {
    opened = NULL;
    knurl_device_close(device);
    assert_int_equal(fake.opens, fake.closes);
    falcon_fake_free(&fake);
}

static inline void sleep_ms(int ms) {
    knurl_system_sleep_until_ns(knurl_system_now_ns() + (int64_t)ms * 1000000);
}

typedef struct outcome {
    int good, not_ready, lost;
    knurl_device_sample newest;
    double step; /* m: longest between two readings */
} outcome;

/* A loop without a scene: reads, writes `force`, for so many ms. */
static inline outcome run(knurl_device *device, int ms, const double force[3]) {
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
static inline knurl_device *open_ready_with(const char *options) {
    knurl_device *device = open_with(options);
    for (int i = 0; i < 1000 && run(device, 1, no_force).good == 0; i++) {}
    knurl_port_release_halt(device);
    return device;
}

static inline knurl_device *open_ready(void) {
    return open_ready_with("");
}

/* The count of a fault since the last call; *others: of all others. */
static inline int events_of(knurl_device *device, int32_t code, int *others) {
    int count = 0;
    knurl_device_event event;
    *others = 0;
    while (knurl_device_next_event(device, &event)) {
        count += event.code == code;
        *others += event.code != code;
    }
    return count;
}

static inline int is_limp(void) {
    const falcon_sim sim = falcon_fake_look(&fake);
    return !sim.motors[0] && !sim.motors[1] && !sim.motors[2];
}

#endif

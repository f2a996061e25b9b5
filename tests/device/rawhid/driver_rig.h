/* Shared by the tests of the raw HID driver: the simulated bus, the device opened on it, ticks as a loop makes them.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_DRIVER_RIG_H
#define KNURL_TEST_DRIVER_RIG_H

#include "support/close.h"
#include "support/double.h"
#include "support/wait.h"

#include "base/vec3.h"
#include "device/port.h"
#include "device/rawhid/fake_hid.h"
#include "device/rawhid/geometry.h"
#include "device/rawhid/kinematics.h"
#include "device/rawhid/rawhid_device.h"
#include "device/rawhid/ticking.h"
#include "device/rawhid/transport.h"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

static fake_hid hid;
static knurl_device *device;

static inline void open_device(const char *options) {
    const knurl_result result = knurl_rawhid_open(options, &hid.bus, &device);
    if (result) {
        print_error("rawhid:%s: %s\n", options, knurl_error_message());
    }
    assert_int_equal(result, KNURL_OK);
}

static inline int set_up(void **state) {
    (void)state;
    fake_hid_init(&hid, 64, NULL);
    return 0;
}

static inline void close_device(void) {
    knurl_device_close(device);
    device = NULL;
}

static inline int tear_down(void **state) {
    (void)state;
    close_device();
    assert_int_equal(hid.opened, hid.closed);
    fake_hid_destroy(&hid);
    return 0;
}

/* Reports that were sent, and commands among them, so far. */
static inline uint32_t reports_sent(void) {
    knurl_system_mutex_lock(&hid.mutex);
    const uint32_t sent = hid.written;
    knurl_system_mutex_unlock(&hid.mutex);
    return sent;
}

static inline uint32_t commands_sent(void) {
    knurl_system_mutex_lock(&hid.mutex);
    const uint32_t commands = hid.sim.commands;
    knurl_system_mutex_unlock(&hid.mutex);
    return commands;
}

/* The last report, its ID first; returns its length. */
static inline size_t last_sent(uint8_t bytes[HID_SIM_MOST_BYTES + 1]) {
    knurl_system_mutex_lock(&hid.mutex);
    const size_t size = hid.last_size;
    memcpy(bytes, hid.last, sizeof hid.last);
    knurl_system_mutex_unlock(&hid.mutex);
    return size;
}

static inline void press_button(void) {
    knurl_system_mutex_lock(&hid.mutex);
    hid.sim.info = 1;
    knurl_system_mutex_unlock(&hid.mutex);
}

static inline void check_open_refused(const char *options, knurl_result code, const char *words) {
    CHECK_REFUSED(knurl_rawhid_open(options, &hid.bus, &device), code, device);
    check_message(words);
    assert_int_equal(hid.opened, hid.closed);
}

static inline int tick_until(knurl_result result, const double force[3], double seconds, knurl_device_sample *sample) {
    return tick_device_until(device, result, force, seconds, sample);
}

static const double none[3] = {0.0, 0.0, 0.0};

static inline knurl_device_sample wait_for_position(void) {
    knurl_device_sample sample;
    assert_true(tick_until(KNURL_OK, none, 5.0, &sample));
    return sample;
}

static inline void open_ready(const char *options) {
    open_device(options);
    (void)wait_for_position();
}

/* Ticks for a time. */
static inline void tick_for(double seconds, const double force[3]) {
    knurl_device_sample sample;
    (void)tick_until(1, force, seconds, &sample);
}

static inline void wait_for_event(int32_t code) {
    knurl_device_event event;
    const int64_t until = knurl_system_now_ns() + 5000000000;
    while (knurl_system_now_ns() < until) {
        while (knurl_device_next_event(device, &event)) {
            if (event.code == code) {
                return;
            }
        }
        tick_for(0.002, none);
    }
    fail_msg("no event '%s'", knurl_fault_name(code));
}

/* Ticks for a time, like a loop that always recovers from a halt. */
static inline void hold(double seconds, const double force[3]) {
    knurl_device_sample sample;
    const int64_t until = knurl_system_now_ns() + (int64_t)(seconds * 1e9);
    while (knurl_system_now_ns() < until) {
        (void)knurl_device_read(device, &sample);
        knurl_port_release_halt(device);
        (void)knurl_device_write(device, force);
        sleep_ms(1.0);
    }
}

static inline int is_near(const double a[3], const double b[3], double tolerance) {
    return fabs(a[0] - b[0]) <= tolerance && fabs(a[1] - b[1]) <= tolerance && fabs(a[2] - b[2]) <= tolerance;
}

static inline uint32_t events_of(int32_t code) {
    knurl_device_event event;
    uint32_t count = 0;
    while (knurl_device_next_event(device, &event)) {
        count += event.code == code;
    }
    return count;
}

static inline void wait_until_limp(void) {
    WAIT_FOR(fake_hid_limp_since(&hid) != 0);
}

static inline void check_zeroed(int fault, int32_t code) {
    static const double force[3] = {0.0, 0.5, 0.0};
    knurl_device_sample sample;
    open_ready("");
    hold(0.05, force);
    fake_hid_inject(&hid, fault);
    assert_true(tick_until(KNURL_ERROR_DEVICE_NOT_READY, force, 5.0, &sample));
    assert_int_equal(knurl_port_is_halted(device), 1);
    wait_until_limp();
    wait_for_event(code);
}

/* Everything well again: positions come, and the force too, once a halt is released. */
static inline void check_recovers(void) {
    fake_hid_inject(&hid, DOUBLE_WELL);
    (void)wait_for_position();
}

#endif

/* The device "mouse": the filter that makes a motion of steps. SPDX-License-Identifier: MIT */
#include "mouse.h"

#include "support/close.h"

#define PI 3.14159265358979323846

typedef struct rig {
    knurl_mouse *m; /* the device's */
    knurl_device *device;
} rig;

static rig r;

static int end(void **state) {
    (void)state;
    knurl_device_close(r.device);
    memset(&r, 0, sizeof r);
    return 0;
}

static void open_rig(double rate) {
    assert_int_equal(knurl_mouse_open(&r.m, &r.device), KNURL_OK);
    assert_int_equal(knurl_device_start(r.device, rate), KNURL_OK);
}

static void move_x(double x) {
    const double position[3] = {x, 0.0, 0.0};
    knurl_mouse_move(r.m, position);
}

static double read_x(void) {
    knurl_device_sample sample;
    assert_int_equal(knurl_device_read(r.device, &sample), KNURL_OK);
    return sample.position[0];
}

TEST_WITH(a_mouse_that_never_moved_gives_no_position, NULL, end) {
    knurl_device_sample sample;
    open_rig(1000.0);
    assert_int_equal(knurl_device_read(r.device, &sample), KNURL_ERROR_DEVICE_NOT_READY);
    move_x(0.3);
    CHECK_SAME(read_x(), 0.3);
}

TEST_WITH(a_steady_motion_lags_25_ms_behind, NULL, end) {
    double x = 0.0;
    open_rig(1000.0);
    for (int tick = 0; tick < 1000; tick++) {
        move_x(1e-4 * tick); /* 0.1 m/s */
        x = read_x();
    }
    CHECK_CLOSE(0.0999 - x, 0.1 * 0.025, 0.1 * 0.0011); /* the target is constant within a tick */
}

/* Steps at 60 Hz are impulses of velocity: 1 + 2 cos(w t) + ...; two poles at a = 80/s pass a^2 / (a^2 + w^2). */
TEST_WITH(steps_at_60_hz_become_a_velocity_with_9_percent_of_ripple, NULL, end) {
    enum { PERIOD = 100, PERIODS = 60 };
    const double rate = 60.0 * PERIOD;
    const double w = 2.0 * PI * 60.0;
    double cosine = 0.0;
    double sine = 0.0;
    double first = 0.0;
    open_rig(rate);
    double before = 0.0;
    for (int tick = 0; tick < 2 * PERIODS * PERIOD; tick++) {
        move_x(0.1 / 60.0 * (tick / PERIOD)); /* 0.1 m/s */
        const double x = read_x();
        if (tick == PERIODS * PERIOD) {
            first = before;
        }
        if (tick >= PERIODS * PERIOD) {
            cosine += (x - before) * cos(2.0 * PI * tick / PERIOD);
            sine += (x - before) * sin(2.0 * PI * tick / PERIOD);
        }
        before = x;
    }
    const double mean = before - first;
    CHECK_CLOSE(mean, 0.1, 1e-6);
    CHECK_CLOSE(2.0 * hypot(cosine, sine) / mean, 2.0 * 80.0 * 80.0 / (80.0 * 80.0 + w * w), 0.002);
}

TEST_WITH(a_leap_becomes_a_move_that_devices_positions_are_believed_at, NULL, end) {
    knurl_device_event event;
    open_rig(1000.0);
    move_x(0.0);
    double x = read_x();
    move_x(2.0);
    for (int tick = 0; tick < 1000; tick++) {
        const double next = read_x();
        assert_true(next >= x && next - x <= 5.0 / 1000.0 * 1.000001);
        x = next;
    }
    CHECK_CLOSE(x, 2.0, 1e-6);
    assert_int_equal(knurl_device_next_event(r.device, &event), 0);
}

/* WoodenHaptics on a serial port: lines, signs, homing, faults. SPDX-License-Identifier: MIT */
#include "device/rawhid/serial_double.h"
#include "support/close.h"

#include "base/system.h"
#include "device/port.h"

static void sleep_ms(int ms) {
    knurl_system_sleep_until_ns(knurl_system_now_ns() + (int64_t)ms * 1000000);
}

/* Writes `force` for `ms`; the last reading. */
static knurl_result run(knurl_device *device, int ms, const double force[3], knurl_device_sample *sample) {
    knurl_result result = KNURL_OK;
    for (int i = 0; i < ms; i++) {
        result = knurl_device_read(device, sample);
        (void)knurl_device_write(device, force);
        sleep_ms(1);
    }
    return result;
}

static const double no_force[3];

static knurl_device *open_released(void) {
    knurl_device_sample sample;
    knurl_device *device = serial_double.open();
    if (!device) {
        fail_msg("%s", knurl_error_message());
    }
    (void)run(device, 30, no_force, &sample);
    knurl_port_release_halt(device);
    return device;
}

TEST(an_arm_in_the_middle_of_its_workspace_is_there) {
    knurl_device_sample sample;
    knurl_device *device = open_released();
    assert_int_equal(run(device, 50, no_force, &sample), KNURL_OK);
    for (int axis = 0; axis < 3; axis++) { /* a count is 0.05 to 0.13 mm */
        CHECK_CLOSE(sample.position[axis], 0.0, 0.0003);
    }
    serial_double.close(device);
}

/* 2000 N/m hold the simulated arm, less 0.3 N of friction. */
TEST(a_force_moves_the_arm_where_it_points) {
    for (int axis = 0; axis < 3; axis++) {
        double force[3] = {0.0, 0.0, 0.0};
        knurl_device_sample sample;
        knurl_device *device = open_released();
        force[axis] = 2.0;
        assert_int_equal(run(device, 500, force, &sample), KNURL_OK);
        CHECK_CLOSE(sample.position[axis], (2.0 - 0.3) / 2000.0, 0.00025);
        for (int other = 1; other < 3; other++) {
            CHECK_CLOSE(sample.position[(axis + other) % 3], 0.0, 0.00025);
        }
        serial_double.close(device);
    }
}

TEST(a_mute_host_is_left_without_force_after_100_ms) {
    const double force[3] = {0.0, 1.0, 0.0};
    knurl_device_sample sample;
    knurl_device *device = open_released();
    (void)run(device, 50, force, &sample);
    assert_true(serial_double.limp_since() == 0);
    serial_double.inject(DOUBLE_HANG);
    const int64_t begin = knurl_system_now_ns();
    sleep_ms(200);
    CHECK_CLOSE(1e-6 * (double)(serial_double.limp_since() - begin), 100.0, 2.0);
    serial_double.inject(DOUBLE_WELL);
    serial_double.close(device);
}

TEST(another_models_firmware_is_named) {
    knurl_device *device = serial_double.open();
    assert_non_null(device);
    knurl_device_close(device);
    serial_double_model(1);
    assert_null(serial_double_open(""));
    check_message("model 1|device 'serial'");
    serial_double_model(3);
    serial_double_press();
    device = serial_double_open("");
    assert_non_null(device);
    serial_double.close(device);
}

/* Upper arm upright, forearm level, pointing at the user: r = 0.245 m out and 0.080 + 0.205 m up, less the origin's
 * 0.220 and 0.080. */
TEST(its_button_and_opening_with_home_take_the_pose_for_home) {
    knurl_device_sample sample;
    knurl_device_event event;
    int was_told = 0;
    knurl_device *device = open_released();
    serial_double_press();
    assert_int_equal(run(device, 200, no_force, &sample), KNURL_OK);
    CHECK_CLOSE(sample.position[2], 0.245 - 0.220, 0.0005);
    CHECK_CLOSE(sample.position[1], 0.080 + 0.205 - 0.080, 0.0005);
    while (knurl_device_next_event(device, &event)) {
        was_told |= event.code == KNURL_FAULT_UNCALIBRATED;
    }
    assert_true(was_told);
    knurl_device_close(device);
    device = serial_double_open("?home=1");
    assert_non_null(device);
    assert_int_equal(run(device, 200, no_force, &sample), KNURL_OK);
    CHECK_CLOSE(sample.position[2], 0.245 - 0.220, 0.0005);
    serial_double.close(device);
}

/* 1 if `line` gives a position. */
static int is_taken(const char *line) {
    knurl_device_sample sample;
    knurl_device *device = open_released();
    (void)run(device, 20, no_force, &sample);
    serial_double_say(line);
    const knurl_result result = run(device, 1000, no_force, &sample);
    serial_double.close(device);
    return result == KNURL_OK;
}

TEST(invalid_lines_make_no_position) {
    static const char *const lines[] = {
        "[]",
        "[3]",
        "[3,0,0,0,0,0,0]",
        "[3,0,0,0,0,0,0,0,0]",
        "[3,0,0,0,0,0,0,x]",
        "[3,,0,0,0,0,0,0]",
        "3,0,0,0,0,0,0,0]",
        "[3,99999,0,0,0,0,0,0]",
        "[3,99999999999999999999,0,0,0,0,0,0]",
        "[2,0,-700,3000,0,0,0,0]",
        "[3,0,-700,3000,0,0,0,1024]",
    };
    for (size_t i = 0; i < COUNT_OF(lines); i++) {
        assert_int_equal(is_taken(lines[i]), 0);
    }
    assert_int_equal(is_taken("[3,0,-1313,3465,0,0,0,0]"), 1); /* the middle of the workspace */
    assert_int_equal(is_taken("[3,0,-1313,3465,0,0,0,5]"), 1); /* a gimbal's sensor is broken */
}

TEST(one_that_lost_its_power_gives_no_position_until_it_is_homed) {
    knurl_device_sample sample;
    knurl_device *device = open_released();
    (void)run(device, 20, no_force, &sample);
    serial_double.inject(DOUBLE_UNPLUG);
    sleep_ms(50);
    assert_int_equal(knurl_device_read(device, &sample), KNURL_ERROR_DEVICE_LOST);
    serial_double.inject(DOUBLE_WELL);
    assert_int_equal(knurl_device_reopen(device), KNURL_OK);
    assert_int_equal(run(device, 100, no_force, &sample), KNURL_ERROR_DEVICE_NOT_READY);
    serial_double_press();
    assert_int_equal(run(device, 200, no_force, &sample), KNURL_OK);
    serial_double.close(device);
}

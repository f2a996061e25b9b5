/* WoodenHaptics on a serial port: lines, signs, homing, faults. SPDX-License-Identifier: MIT */
#include "device/rawhid/serial_double.h"
#include "device/ticked.h"

#include "base/system.h"

static int end(void **state) {
    (void)state;
    if (device) {
        serial_double.close(device);
    }
    device = NULL;
    return 0;
}

static void open_released(void) {
    (void)end(NULL);
    device = serial_double.open();
    run_released();
}

TEST_WITH(an_arm_in_the_middle_of_its_workspace_is_there, NULL, end) {
    open_released();
    assert_int_equal(run(50, none), KNURL_OK);
    for (int axis = 0; axis < 3; axis++) { /* a count is 0.05 to 0.13 mm */
        CHECK_CLOSE(latest.position[axis], 0.0, 0.0003);
    }
}

/* 2000 N/m hold the simulated arm, less 0.3 N of friction. */
TEST_WITH(a_force_moves_the_arm_where_it_points, NULL, end) {
    for (int axis = 0; axis < 3; axis++) {
        double force[3] = {0.0, 0.0, 0.0};
        open_released();
        force[axis] = 2.0;
        assert_int_equal(run(500, force), KNURL_OK);
        CHECK_CLOSE(latest.position[axis], (2.0 - 0.3) / 2000.0, 0.00025);
        for (int other = 1; other < 3; other++) {
            CHECK_CLOSE(latest.position[(axis + other) % 3], 0.0, 0.00025);
        }
    }
}

TEST_WITH(a_mute_host_is_left_without_force_after_100_ms, NULL, end) {
    const double force[3] = {0.0, 1.0, 0.0};
    open_released();
    (void)run(50, force);
    assert_true(serial_double.limp_since() == 0);
    serial_double.inject(DOUBLE_HANG);
    const int64_t begin = knurl_system_now_ns();
    sleep_ms(200.0);
    CHECK_CLOSE(1e-6 * (double)(serial_double.limp_since() - begin), 100.0, 2.0);
    serial_double.inject(DOUBLE_WELL);
}

TEST_WITH(another_models_firmware_is_named, NULL, end) {
    device = serial_double.open();
    assert_non_null(device);
    (void)close_device(NULL);
    serial_double_model(1);
    assert_null(serial_double_open(""));
    check_message("model 1|device 'serial'");
    serial_double_model(3);
    serial_double_press();
    device = serial_double_open("");
    assert_non_null(device);
}

/* Upper arm upright, forearm level, pointing at the user: r = 0.245 m out and 0.080 + 0.205 m up, less the origin's
 * 0.220 and 0.080. */
TEST_WITH(its_button_and_opening_with_home_take_the_pose_for_home, NULL, end) {
    knurl_device_event event;
    int was_told = 0;
    open_released();
    serial_double_press();
    assert_int_equal(run(200, none), KNURL_OK);
    CHECK_CLOSE(latest.position[2], 0.245 - 0.220, 0.0005);
    CHECK_CLOSE(latest.position[1], 0.080 + 0.205 - 0.080, 0.0005);
    while (knurl_device_next_event(device, &event)) {
        was_told |= event.code == KNURL_FAULT_UNCALIBRATED;
    }
    assert_true(was_told);
    (void)close_device(NULL);
    device = serial_double_open("?home=1");
    assert_non_null(device);
    assert_int_equal(run(200, none), KNURL_OK);
    CHECK_CLOSE(latest.position[2], 0.245 - 0.220, 0.0005);
}

/* 1 if `line` gives a position. */
static int is_taken(const char *line) {
    open_released();
    (void)run(20, none);
    serial_double_say(line);
    const knurl_result result = run(1000, none);
    return result == KNURL_OK;
}

TEST_WITH(invalid_lines_make_no_position, NULL, end) {
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

TEST_WITH(one_that_lost_its_power_gives_no_position_until_it_is_homed, NULL, end) {
    open_released();
    (void)run(20, none);
    serial_double.inject(DOUBLE_UNPLUG);
    sleep_ms(50.0);
    assert_int_equal(knurl_device_read(device, &latest), KNURL_ERROR_DEVICE_LOST);
    serial_double.inject(DOUBLE_WELL);
    assert_int_equal(knurl_device_reopen(device), KNURL_OK);
    assert_int_equal(run(100, none), KNURL_ERROR_DEVICE_NOT_READY);
    serial_double_press();
    assert_int_equal(run(200, none), KNURL_OK);
}

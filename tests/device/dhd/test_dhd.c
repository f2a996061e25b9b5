/* Force Dimension's devices over the stand-in library: axes, forces, orientation, faults, ends.
 * SPDX-License-Identifier: MIT */
#include "device/dhd/dhd_double.h"
#include "support/close.h"

#include "base/system.h"

#include <knurl/device.h>
#include <stdlib.h>

static knurl_result run(knurl_device *device, int ms, const double force[3], knurl_device_sample *sample) {
    knurl_result result = KNURL_OK;
    for (int i = 0; i < ms; i++) {
        result = knurl_device_read(device, sample);
        (void)knurl_device_write(device, force);
        knurl_system_sleep_until_ns(knurl_system_now_ns() + 1000000);
    }
    return result;
}

static const double none[3];

static knurl_device *open_released(void) {
    knurl_device_sample sample;
    knurl_device *device = dhd_double.open();
    if (!device) {
        fail_msg("%s", knurl_error_message());
    }
    (void)run(device, 30, none, &sample);
    knurl_device_release_halt(device);
    return device;
}

/* Against a hand of 700 N/m; friction may hold up to 0.3 N more or less. */
TEST(a_force_moves_the_grip_where_it_points_and_no_torque_goes_out) {
    for (int axis = 0; axis < 3; axis++) {
        knurl_device_sample sample;
        double force[3] = {0.0, 0.0, 0.0};
        double told[3];
        double others[3];
        knurl_device *device = open_released();
        force[axis] = 2.0;
        assert_int_equal(run(device, 1000, force, &sample), KNURL_OK);
        CHECK_CLOSE(sample.position[axis], 2.0 / 700.0, 0.3 / 700.0 + 0.00002);
        CHECK_CLOSE(sample.position[(axis + 1) % 3], 0.0, 0.00002);
        dhd_stub.ask(told, others);
        CHECK_CLOSE(told[axis], 2.0, 1e-12);
        CHECK_SAME(others[0], 0.0L);
        assert_int_equal(sample.buttons, 1); /* from its first second on */
        dhd_double.close(device);
        assert_int_equal(dhd_stub.opens(), 0);
    }
}

/* By 90 degrees about what points up: in Knurl's axes about y. */
TEST(the_orientation_of_the_grip_is_told) {
    knurl_device_sample sample;
    knurl_device *device = open_released();
    assert_int_equal(run(device, 10, none, &sample), KNURL_OK);
    const double half = 0.7071067811865476;
    CHECK_CLOSE(sample.orientation[0], 0.0, 1e-15);
    CHECK_CLOSE(sample.orientation[1], half, 1e-15);
    CHECK_CLOSE(sample.orientation[2], 0.0, 1e-15);
    CHECK_CLOSE(sample.orientation[3], half, 1e-15);
    dhd_double.close(device);
}

TEST(forces_are_no_stronger_than_it_can_play) {
    const double force[3] = {0.0, 100.0, 0.0};
    knurl_device_sample sample;
    double told[3];
    double others[3];
    knurl_device_info info;
    knurl_device *device = open_released();
    assert_int_equal(run(device, 10, force, &sample), KNURL_OK);
    dhd_stub.ask(told, others);
    CHECK_CLOSE(told[1], 12.0, 1e-12);
    knurl_device_info_init(&info, sizeof info);
    assert_int_equal(knurl_device_get_info(device, &info), KNURL_OK);
    assert_string_equal(info.name, "Force Dimension omega.3");
    CHECK_CLOSE(info.max_stiffness, 5000.0, 1e-9);
    dhd_double.close(device);
}

TEST(what_cannot_be_opened_says_why) {
    knurl_device *device = open_released();
    knurl_device *other = NULL;
    dhd_double.close(device);
    CHECK_REFUSED(knurl_device_open("dhd:1", &other), KNURL_ERROR_DEVICE_LOST, other);
    check_message("device 'dhd:1': found 1 Force Dimension devices");
    CHECK_REFUSED(knurl_device_open("dhd:x", &other), KNURL_ERROR_ARGUMENT, other);
    check_message("dhd:x");
    CHECK_REFUSED(knurl_device_open("dhd:99", &other), KNURL_ERROR_ARGUMENT, other);
    assert_int_equal(dhd_stub.opens(), 0);
}

TEST(a_pulled_cable_is_a_loss_and_the_device_is_had_back) {
    knurl_device_sample sample;
    knurl_device *device = open_released();
    dhd_double.inject(DOUBLE_UNPLUG);
    assert_int_equal(run(device, 20, none, &sample), KNURL_ERROR_DEVICE_LOST);
    assert_int_equal(knurl_device_start(device, 1000.0), KNURL_ERROR_DEVICE_LOST);
    dhd_double.inject(DOUBLE_WELL);
    assert_int_equal(knurl_device_start(device, 1000.0), KNURL_OK);
    assert_int_equal(run(device, 50, none, &sample), KNURL_OK);
    dhd_double.close(device);
    assert_int_equal(dhd_stub.opens(), 0);
}

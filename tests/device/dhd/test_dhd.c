/* Force Dimension's devices over the stand-in library: axes, forces, orientation, faults, ends.
 * SPDX-License-Identifier: MIT */
#include "device/dhd/dhd_double.h"
#include "device/ticked.h"

#include "base/atomic.h"
#include "device/driver.h"

#include <knurl/device.h>
#include <knurl/loop.h>

static int end(void **state) {
    (void)close_device(state);
    return dhd_stub.opens && dhd_stub.opens() != 0;
}

static void open_released(void) {
    (void)close_device(NULL);
    device = dhd_double.open();
    run_released();
}

/* Against a hand of 700 N/m; friction may hold up to 0.3 N more or less. */
TEST_WITH(a_force_moves_the_grip_where_it_points_and_no_torque_goes_out, NULL, end) {
    for (int axis = 0; axis < 3; axis++) {
        double force[3] = {0.0, 0.0, 0.0};
        double told[3];
        double others[3];
        open_released();
        force[axis] = 2.0;
        assert_int_equal(run(1000, force), KNURL_OK);
        CHECK_CLOSE(latest.position[axis], 2.0 / 700.0, 0.3 / 700.0 + 0.00002);
        CHECK_CLOSE(latest.position[(axis + 1) % 3], 0.0, 0.00002);
        dhd_stub.ask(told, others);
        CHECK_CLOSE(told[axis], 2.0, 1e-12);
        CHECK_SAME(others[0], 0.0L);
        assert_int_equal(latest.buttons, 1); /* from its first second on */
        assert_int_equal(end(NULL), 0);
    }
}

/* By 90 degrees about the vertical, Knurl's y. */
TEST_WITH(the_orientation_of_the_grip_is_reported, NULL, end) {
    open_released();
    assert_int_equal(run(10, none), KNURL_OK);
    const double half = 0.7071067811865476;
    CHECK_CLOSE(latest.orientation[0], 0.0, 1e-15);
    CHECK_CLOSE(latest.orientation[1], half, 1e-15);
    CHECK_CLOSE(latest.orientation[2], 0.0, 1e-15);
    CHECK_CLOSE(latest.orientation[3], half, 1e-15);
}

TEST_WITH(forces_are_no_stronger_than_it_can_play, NULL, end) {
    const double force[3] = {0.0, 100.0, 0.0};
    double told[3];
    double others[3];
    open_released();
    assert_int_equal(run(10, force), KNURL_OK);
    dhd_stub.ask(told, others);
    CHECK_CLOSE(told[1], 12.0, 1e-12);
    const knurl_device_info info = device_info(device);
    assert_string_equal(info.name, "Force Dimension omega.3");
    CHECK_CLOSE(info.max_stiffness, 5000.0, 1e-9);
}

/* Its button switches the forces off; the zero that follows does not arrive. */
TEST_WITH(a_zero_that_was_refused_while_forces_are_off_does_not_count_as_sent, NULL, end) {
    const double force[3] = {0.0, 2.0, 0.0};
    open_released();
    assert_int_equal(run(20, force), KNURL_OK);
    dhd_stub.set(STUB_DHD_REFUSES, 1);
    dhd_double.inject(DOUBLE_OFF);
    (void)run(30, force);
    assert_int_equal(knurl_load_acquire(&device->quiet), 0);
    dhd_stub.set(STUB_DHD_REFUSES, 0);
    (void)run(30, force);
    assert_int_equal(knurl_load_acquire(&device->quiet), 1);
    dhd_double.inject(DOUBLE_WELL);
}

/* As the maker's header numbers them; a lambda.3 and .6, a sigma.3 and .6 are taken for their families' others. */
TEST_WITH(every_type_is_known_by_its_force_and_stiffness, NULL, end) {
    static const struct {
        int type;
        double max_force, max_stiffness;
    } cases[] = {{33, 12, 5000},  {63, 20, 5000},  {104, 12, 4000}, {105, 12, 4000}, {106, 12, 4000},
                 {107, 12, 4000}, {206, 12, 4000}, {108, 12, 4000}, {109, 12, 4000}, {131, 12, 4000},
                 {132, 12, 4000}, {203, 12, 4000}, {60, 8, 3000},   {91, 8, 3000}};
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        open_released();
        dhd_stub.set(STUB_DHD_TYPE, cases[i].type);
        dhd_double.inject(DOUBLE_UNPLUG);
        (void)run(20, none);
        (void)close_device(NULL);
        dhd_double.inject(DOUBLE_WELL);
        assert_int_equal(knurl_device_open("dhd", &device), KNURL_OK);
        const knurl_device_info info = device_info(device);
        if (info.max_force != cases[i].max_force || info.max_stiffness != cases[i].max_stiffness) {
            fail_msg("type %d: %g N, %g N/m", cases[i].type, info.max_force, info.max_stiffness);
        }
    }
}

/* Lets the loop run; returns the count of this event, and its value. */
static int wait_and_count(int ms, int32_t code, double *value) {
    knurl_device_event event;
    int count = 0;
    sleep_ms(ms);
    while (knurl_device_next_event(device, &event)) {
        if (event.code == code) {
            count++;
            *value = event.value;
        }
    }
    return count;
}

/* Its button, its velocity threshold, its watchdog, a call, the cable, the grip; and one that this version does not
 * know. A rise of the ramp's: 1.28 N in 20 ms. */
TEST_WITH(forces_that_are_switched_off_at_the_device_are_an_event_with_its_cause_and_come_back_by_a_ramp, NULL, end) {
    static const int causes[][2] = {{1, 1}, {2, 2}, {3, 3}, {4, 4}, {5, 5}, {6, 6}, {9, 0}};
    for (size_t i = 0; i < COUNT_OF(causes); i++) {
        double asked[3] = {0.0, 1.28, 0.0};
        double force[3];
        double others[3];
        double value = -1.0;
        device = dhd_double.open();
        const knurl_loop_desc desc = push_desc(device, asked);
        knurl_loop *loop = start_push(&desc);
        (void)wait_and_count(300, 0, &value);
        dhd_stub.ask(force, others);
        CHECK_CLOSE(force[1], 1.28, 1e-12);
        dhd_stub.set(STUB_DHD_CAUSE, causes[i][0]);
        dhd_double.inject(DOUBLE_OFF);
        assert_int_equal(wait_and_count(500, KNURL_FAULT_FORCE_OFF, &value), 1);
        CHECK_SAME(value, (long double)causes[i][1]);
        dhd_stub.ask(force, others);
        if (others[1] > 11.0) { /* status is read every 10 exchanges */
            fail_msg("told %g forces that were not played", others[1]);
        }
        dhd_double.inject(DOUBLE_WELL);
        assert_int_equal(wait_and_count(200, KNURL_FAULT_RESUMED, &value), 1);
        dhd_stub.ask(force, others);
        CHECK_CLOSE(force[1], 1.28, 1e-12);
        if (others[2] > 1.28 / 20.0 * 2.0) { /* two ticks may fall between two exchanges */
            fail_msg("came back by %g N in one exchange", others[2]);
        }
        knurl_loop_destroy(loop);
        (void)close_device(NULL);
    }
}

TEST_WITH(a_failed_open_gives_the_reason, NULL, end) {
    open_released();
    knurl_device *other = NULL;
    (void)close_device(NULL);
    CHECK_REFUSED(knurl_device_open("dhd:1", &other), KNURL_ERROR_DEVICE_LOST, other);
    check_message("device 'dhd:1': found 1 Force Dimension devices");
    CHECK_REFUSED(knurl_device_open("dhd:x", &other), KNURL_ERROR_ARGUMENT, other);
    check_message("dhd:x");
    CHECK_REFUSED(knurl_device_open("dhd:99", &other), KNURL_ERROR_ARGUMENT, other);
    assert_int_equal(dhd_stub.opens(), 0);
}

/* An omega (type 33, 12 N) is unplugged, and a Falcon (type 60, 8 N) has its place: the force limit is still the
 * omega's. */
TEST_WITH(another_model_in_its_place_is_not_had_back, NULL, end) {
    dhd_stub.set(STUB_DHD_TYPE, 33);
    open_released();
    dhd_double.inject(DOUBLE_UNPLUG);
    assert_int_equal(run(20, none), KNURL_ERROR_DEVICE_LOST);
    dhd_stub.set(STUB_DHD_TYPE, 60);
    dhd_double.inject(DOUBLE_WELL);
    assert_int_equal(knurl_device_start(device, 1000.0), KNURL_ERROR_DEVICE_LOST);
    dhd_stub.set(STUB_DHD_TYPE, 33);
    assert_int_equal(knurl_device_start(device, 1000.0), KNURL_OK);
    assert_int_equal(run(50, none), KNURL_OK);
}

TEST_WITH(a_pulled_cable_is_a_loss_and_the_device_is_had_back, NULL, end) {
    open_released();
    dhd_double.inject(DOUBLE_UNPLUG);
    assert_int_equal(run(20, none), KNURL_ERROR_DEVICE_LOST);
    assert_int_equal(knurl_device_start(device, 1000.0), KNURL_ERROR_DEVICE_LOST);
    dhd_double.inject(DOUBLE_WELL);
    assert_int_equal(knurl_device_start(device, 1000.0), KNURL_OK);
    assert_int_equal(run(50, none), KNURL_OK);
}

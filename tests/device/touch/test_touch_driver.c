/* The Touch driver over the stub, turn by turn: units, forces, faults, ends. SPDX-License-Identifier: MIT */
#include "device/touch/stub.h"

#include "device/driver.h"
#include "device/port.h"

/* --- information --- */

TEST_WITH(what_hd_tells_of_the_device_comes_in_si, stub_by_hand, stub_check) {
    SCOPED_DEVICE *device = stub_open("touch");
    const knurl_device_info info = device_info(device);
    assert_string_equal(info.name, "3D Systems Touch (Touch of straw)");
    CHECK_CLOSE(info.workspace_min[0], -0.080, 1e-12); /* the stub's: +-80, 60, 35 mm */
    CHECK_CLOSE(info.workspace_max[1], 0.060, 1e-12);
    CHECK_CLOSE(info.workspace_max[2], 0.035, 1e-12);
    CHECK_CLOSE(info.max_force, 3.3, 1e-12);
    CHECK_CLOSE(info.continuous_force, 0.9, 1e-12);
    CHECK_CLOSE(info.max_stiffness, 1100.0, 1e-9); /* 1.1 N/mm */
    CHECK_CLOSE(info.resolution, 0.055e-3, 1e-12);
    assert_true(info.heat_time > 0.0 && info.mass > 0.0);
}

TEST_WITH(what_hd_does_not_tell_comes_from_the_data_sheet, stub_by_hand, stub_check) {
    stub.set(STUB_DEFAULT, STUB_TELLS_NOTHING, 1.0);
    SCOPED_DEVICE *device = stub_open("touch");
    const knurl_device_info info = device_info(device);
    assert_string_equal(info.name, "3D Systems Touch (unknown model)");
    CHECK_CLOSE(info.workspace_max[0] - info.workspace_min[0], 0.160, 1e-12);
    CHECK_CLOSE(info.workspace_max[1] - info.workspace_min[1], 0.120, 1e-12);
    CHECK_CLOSE(info.workspace_max[2] - info.workspace_min[2], 0.070, 1e-12);
    CHECK_CLOSE(info.max_force, 3.3, 1e-12);
    CHECK_CLOSE(info.continuous_force, 0.88, 1e-12);
    CHECK_CLOSE(info.max_stiffness, 1020.0, 1e-9);
}

TEST_WITH(random_properties_are_never_believed_where_they_make_no_sense, stub_by_hand, stub_check) {
    for (int turn = 0; turn < 2000; turn++) {
        stub.set(STUB_DEFAULT, STUB_RANDOM, 1.0);
        SCOPED_DEVICE *device = stub_open("touch");
        const knurl_device_info info = device_info(device);
        assert_true(info.max_force > 0.0 && info.max_force <= 100.0);
        assert_true(info.continuous_force > 0.0 && info.continuous_force <= info.max_force);
        assert_true(info.max_stiffness > 0.0);
        for (int axis = 0; axis < 3; axis++) {
            assert_true(info.workspace_min[axis] < info.workspace_max[axis]);
            assert_true(fabs(info.workspace_min[axis]) <= 10.0 && fabs(info.workspace_max[axis]) <= 10.0);
        }
    }
}

TEST_WITH(a_device_that_cannot_be_opened_is_given_back_and_says_why, stub_by_hand, stub_check) {
    static const struct {
        double error;
        knurl_result result;
        const char *word;
    } table[] = {{0x0600, KNURL_ERROR_SYSTEM, "licence"},
                 {0x0301, KNURL_ERROR_SYSTEM, "in use"},
                 {0x0303, KNURL_ERROR_DEVICE_LOST, "GTDD_HOME"},
                 {0x0777, KNURL_ERROR_SYSTEM, "unknown to this version"}};
    for (size_t i = 0; i < COUNT_OF(table); i++) {
        knurl_device *device = NULL;
        stub.set(STUB_DEFAULT, STUB_INIT_ERROR, table[i].error);
        CHECK_REFUSED(knurl_device_open("touch", &device), table[i].result, device);
        check_message(table[i].word);
        assert_true(stub.ask(STUB_DEFAULT, STUB_INITIALISED) == 0.0);
    }
}

/* HAPI warns of it: the second call, by another name of the default device, returns 70707 and no error. */
TEST_WITH(a_handle_that_is_none_is_refused_with_the_first_calls_error, stub_by_hand, stub_check) {
    knurl_device *device = NULL;
    stub.set(0, STUB_GARBAGE, 1.0);
    stub.set(STUB_DEFAULT, STUB_ABSENT, 1.0);
    CHECK_REFUSED(knurl_device_open("touch", &device), KNURL_ERROR_DEVICE_LOST, device);
    check_message("0x0302");
    CHECK_REFUSED(knurl_device_open("touch", &device), KNURL_ERROR_DEVICE_LOST, device);
}

/* --- positions and forces --- */

/* The stub's stylus is turned by 120 degrees about (1, 1, 1): x to y, y to z, z to x. */
TEST_WITH(the_orientation_of_the_stylus_is_told, stub_by_hand, stub_check) {
    start(0.0);
    stub.turn(10);
    const knurl_device_status status = device_status(bench.device);
    for (int i = 0; i < 4; i++) {
        CHECK_CLOSE(status.orientation[i], 0.5, 1e-15); /* cos 60 degrees, and sin 60 degrees / sqrt 3 */
    }
}

/* Three of the arm, then three of the gimbal; -0.3 and 3 are the stub's last ones. */
TEST_WITH(the_joints_angles_are_in_the_sample, stub_by_hand, stub_check) {
    start(0.0);
    stub.turn(10);
    assert_int_equal(bench.push.joint_count, 6);
    CHECK_CLOSE(bench.push.joints[2], -0.3, 1e-15);
    CHECK_CLOSE(bench.push.joints[5], 3.0, 1e-15);
}

TEST_WITH(positions_come_in_metres_and_buttons_as_bits, stub_by_hand, stub_check) {
    stub.set(STUB_DEFAULT, STUB_STROKE, KNURL_STROKE_REST);
    start(0.0);
    stub.turn(1500);
    CHECK_CLOSE(stub.ask(STUB_DEFAULT, STUB_DEPTH), 0.001, 0.0005); /* a hand at rest, 1 mm below, dry friction */
    CHECK_CLOSE(bench.push.from[1], -stub.ask(STUB_DEFAULT, STUB_DEPTH), 0.00006); /* an encoder's step */
    CHECK_CLOSE(bench.push.from[0], 0.0, 0.0005);
    assert_int_equal(bench.push.buttons, 1);
}

TEST_WITH(the_force_of_a_tick_is_what_the_motors_are_told_in_its_frame, stub_by_hand, stub_check) {
    start(1.25);
    stub.turn(1);
    CHECK_CLOSE(told(), 1.25, 1e-12);
    bench.push.force[1] = -0.5;
    stub.turn(1);
    CHECK_CLOSE(told(), 0.5, 1e-12);
    assert_int_equal(bench.push.ticks, 2);
}

TEST_WITH(forces_are_shortened_to_what_the_device_can_play_and_are_never_nan, stub_by_hand, stub_check) {
    start(100.0);
    stub.turn(3);
    CHECK_CLOSE(told(), 3.3, 1e-9);
    bench.push.force[0] = NAN;
    stub.turn(3);
    assert_true(told() == 0.0);
    assert_true(stub.ask(STUB_DEFAULT, STUB_TOLD_BAD) == 0.0);
    assert_true(stub.ask(STUB_DEFAULT, STUB_TOLD_MOST) <= 3.3 + 1e-9);
    bench.push.force[0] = 0.0;
}

TEST_WITH(a_device_that_is_halted_has_no_force_within_a_frame_and_comes_back_by_the_ramp, stub_by_hand, stub_check) {
    start(1.0);
    stub.turn(5);
    knurl_device_halt(bench.device);
    stub.turn(1);
    assert_true(told() == 0.0);
    stub.turn(1);
    assert_true(told() > 0.0 && told() < 0.1); /* a ramp of 20 ticks */
    stub.turn(30);
    CHECK_CLOSE(told(), 1.0, 1e-12);
}

TEST_WITH(it_counts_as_quiet_only_when_the_frame_without_a_force_is_out, stub_by_hand, stub_check) {
    start(1.0);
    assert_int_equal(bench.device->quiet, 1);
    stub.turn(2);
    assert_int_equal(bench.device->quiet, 0);
    knurl_device_halt(bench.device);
    assert_int_equal(bench.device->quiet, 0);
    stub.turn(1);
    assert_int_equal(bench.device->quiet, 1);
}

/* --- a servo thread's own ticks --- */

typedef struct ticker {
    knurl_device *device;
    uint64_t calls;
    uint64_t last;   /* call that returns 0 */
    uint64_t writes; /* calls that write a force */
    int halts;       /* 1: halts after it wrote */
} ticker;

static uint32_t tick(void *argument) {
    static const double force[3] = {0.0, 1.0, 0.0};
    ticker *t = argument;
    knurl_device_sample sample;
    t->calls++;
    (void)knurl_device_read(t->device, &sample);
    if (t->calls <= t->writes) {
        (void)knurl_device_write(t->device, force);
    }
    if (t->halts) {
        knurl_device_halt(t->device);
    }
    return t->calls < t->last;
}

static ticker serve(uint64_t last, uint64_t writes) {
    const ticker t = {stub_open("touch"), 0, last, writes, 0};
    assert_int_equal(knurl_device_start(t.device, 1000.0), KNURL_OK);
    return t;
}

TEST_WITH(a_tick_is_never_called_again_after_it_returned_0, stub_by_hand, stub_check) {
    ticker t = serve(5, 5);
    assert_int_equal(t.device->driver->serve(t.device, tick, &t), KNURL_OK);
    stub.turn(50);
    assert_int_equal(t.calls, 5);
    assert_true(stub.ask(0, STUB_CALLBACKS) == 0.0);
    assert_true(told() == 0.0); /* even though its last call wrote a force */
    t.last = 8;
    assert_int_equal(t.device->driver->serve(t.device, tick, &t), KNURL_OK); /* another loop */
    stub.turn(50);
    assert_int_equal(t.calls, 8);
    knurl_device_close(t.device);
}

TEST_WITH(a_tick_that_writes_nothing_leaves_no_force, stub_by_hand, stub_check) {
    ticker t = serve(1000, 10);
    assert_int_equal(t.device->driver->serve(t.device, tick, &t), KNURL_OK);
    stub.turn(10);
    assert_true(told() == 1.0);
    stub.turn(1);
    assert_true(told() == 0.0);
    knurl_device_close(t.device);
}

TEST_WITH(a_force_whose_device_is_halted_after_it_was_written_does_not_go_out, stub_by_hand, stub_check) {
    ticker t = serve(1000, 1000);
    t.halts = 1;
    assert_int_equal(t.device->driver->serve(t.device, tick, &t), KNURL_OK);
    stub.turn(10);
    assert_true(stub.ask(STUB_DEFAULT, STUB_TOLD_MOST) == 0.0);
    knurl_device_close(t.device);
}

TEST_WITH(closing_zeroes_the_force_and_nothing_is_called_any_more, stub_by_hand, stub_check) {
    ticker t = serve(1000, 1000);
    assert_int_equal(t.device->driver->serve(t.device, tick, &t), KNURL_OK);
    stub.turn(10);
    assert_true(told() == 1.0);
    knurl_device_close(t.device);
    assert_true(told() == 0.0);
    stub.turn(10);
    assert_int_equal(t.calls, 10);
}

TEST_WITH(it_can_be_read_and_written_only_in_a_tick, stub_by_hand, stub_check) {
    static const double force[3] = {0.0, 1.0, 0.0};
    knurl_device_sample sample;
    start(0.0);
    assert_int_equal(knurl_device_read(bench.device, &sample), KNURL_ERROR_STATE);
    assert_int_equal(knurl_device_write(bench.device, force), KNURL_ERROR_STATE);
    stub.turn(2);
    assert_int_equal(knurl_device_read(bench.device, &sample), KNURL_ERROR_STATE);
    assert_int_equal(knurl_device_write(bench.device, force), KNURL_ERROR_STATE);
    stub.turn(1);
    assert_true(stub.ask(STUB_DEFAULT, STUB_TOLD_MOST) == 0.0);
    assert_int_equal(knurl_port_is_halted(bench.device), 0);
}

TEST_WITH(a_loop_cannot_be_stepped, stub_by_hand, stub_check) {
    knurl_loop *loop = NULL;
    stub_push push = {.buttons = 0};
    SCOPED_DEVICE *device = stub_open("touch");
    const knurl_loop_desc desc = stub_loop_desc(device, &push);
    assert_int_equal(knurl_loop_create(&desc, &loop), KNURL_OK);
    assert_int_equal(knurl_loop_step(loop, 1), KNURL_ERROR_UNSUPPORTED);
    knurl_loop_destroy(loop);
}

/* --- the rate --- */

TEST_WITH(the_scheduler_runs_at_the_rate_of_the_loop, stub_by_hand, stub_check) {
    SCOPED_DEVICE *device = stub_open("touch");
    assert_int_equal(knurl_device_start(device, 500.0), KNURL_OK);
    assert_true(stub.ask(0, STUB_RATE) == 500.0);
}

TEST_WITH(rates_that_the_scheduler_cannot_keep_are_refused, stub_by_hand, stub_check) {
    SCOPED_DEVICE *device = stub_open("touch");
    stub.set(0, STUB_REFUSED_RATE, 2000.0);
    (void)knurl_fail(KNURL_OK, "stale message");
    assert_int_equal(knurl_device_start(device, 2000.0), KNURL_ERROR_UNSUPPORTED);
    check_message("2000 Hz|0x0101");
    assert_int_equal(knurl_device_start(device, 1000.5), KNURL_ERROR_UNSUPPORTED);
    check_message("1000.5 Hz");
    assert_true(stub.ask(0, STUB_RATE) == 1000.0);
}

TEST_WITH(a_scheduler_that_changes_no_rate_is_taken_at_the_rate_that_it_has, stub_by_hand, stub_check) {
    stub.set(0, STUB_RATE_ERROR, 0x0102); /* OpenHaptics 3.0 */
    knurl_device *device = stub_open("touch");
    assert_int_equal(knurl_device_start(device, 1000.0), KNURL_OK);
    assert_int_equal(knurl_device_start(device, 500.0), KNURL_ERROR_UNSUPPORTED);
    check_message("expected 1000 Hz");
    knurl_device_close(device);
    start(1.0);
    stub.turn(100);
    CHECK_CLOSE(told(), 1.0, 1e-12);
}

TEST_WITH(a_timer_error_of_a_refused_rate_is_no_lost_device, stub_by_hand, stub_check) {
    SCOPED_DEVICE *device = stub_open("touch");
    stub.set(0, STUB_RATE_ERROR, 0x0304);
    assert_int_equal(knurl_device_start(device, 2000.0), KNURL_ERROR_UNSUPPORTED);
    stub.set(0, STUB_RATE_ERROR, 0.0);
    assert_int_equal(knurl_device_start(device, 1000.0), KNURL_OK);
    stub_push push = {.force = {0.0, 1.0, 0.0}};
    const knurl_loop_desc desc = stub_loop_desc(device, &push);
    knurl_loop *loop = stub_loop(&desc);
    stub.turn(100);
    const knurl_device_status status = device_status(device);
    assert_int_equal(status.lost, 0);
    CHECK_CLOSE(told(), 1.0, 1e-12);
    stub_end_loop(loop);
}

SUITE_FIXTURES(stub_load, stub_unload)

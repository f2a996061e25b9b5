/* Faults of a Touch: losses, refusals, calibration, invalid data, a stalled scheduler.
 * SPDX-License-Identifier: MIT */
#include "device/touch/stub.h"

#include "device/driver.h"
#include "device/port.h"

/* --- losses --- */

/* Counts its calls; continues like a loop that waits for its device. */
static uint32_t count_calls(void *argument) {
    knurl_device **device = argument;
    knurl_device_sample sample;
    (*device)->max_speed += 1.0; /* abused as a counter */
    (void)knurl_device_read(*device, &sample);
    return 1;
}

TEST_WITH(a_device_that_is_lost_is_told_of_once_and_not_served_any_more, stub_by_hand, stub_check) {
    SCOPED_DEVICE *device = stub_open("touch");
    device->max_speed = 100.0;
    assert_int_equal(knurl_device_start(device, 1000.0), KNURL_OK);
    assert_int_equal(device->driver->serve(device, count_calls, &device), KNURL_OK);
    stub.turn(10);
    stub.set(STUB_DEFAULT, STUB_ABSENT, 1.0);
    stub.turn(50);
    assert_true(device->max_speed == 112.0); /* the frame that failed, and the call that reports it */
    assert_int_equal(stub_events(device, KNURL_FAULT_LOST, NULL), 1);
    assert_true(stub.ask(0, STUB_CALLBACKS) == 0.0);
    assert_int_equal(knurl_device_reopen(device), KNURL_ERROR_DEVICE_LOST);
    assert_int_equal(knurl_device_reopen(device), KNURL_ERROR_DEVICE_LOST);
    stub.set(STUB_DEFAULT, STUB_ABSENT, 0.0);
    assert_int_equal(knurl_device_reopen(device), KNURL_OK);
    stub.turn(10);
    assert_true(device->max_speed == 122.0);
    assert_int_equal(stub_events(device, KNURL_FAULT_RECONNECTED, NULL), 1);
    assert_true(stub.ask(0, STUB_STARTS) == 2.0 && stub.ask(0, STUB_MISUSES) == 0.0);
}

TEST_WITH(every_error_that_is_a_loss_ends_the_loop, stub_by_hand, stub_check) {
    static const double codes[] = {0x0104, 0x0300, 0x0301, 0x0302, 0x0303};
    for (size_t i = 0; i < COUNT_OF(codes); i++) {
        start(1.0);
        stub.turn(3);
        stub.set(STUB_DEFAULT, STUB_ERROR, codes[i]);
        stub.turn(3);
        stub.set(STUB_DEFAULT, STUB_ERROR, 0.0);
        assert_int_equal(stub_loop_state(bench.loop), KNURL_LOOP_LOST);
        assert_int_equal(device_status(bench.device).lost, 1);
        stub_close(&bench);
    }
}

TEST_WITH(a_loop_that_reconnects_goes_on_by_itself_in_real_time, stub_by_hand, stub_check) {
    stub.set(0, STUB_BY_HAND, 0.0);
    stub_start(&bench, "touch", 1.0, 1);
    stub.set(STUB_DEFAULT, STUB_ABSENT, 1.0);
    WAIT_FOR(device_status(bench.device).lost);
    assert_int_equal(stub_loop_state(bench.loop), KNURL_LOOP_RUNNING);
    stub.set(STUB_DEFAULT, STUB_ABSENT, 0.0);
    const uint64_t ticks = stub_ticks(&bench);
    WAIT_FOR(stub_ticks(&bench) >= ticks + 50);
    assert_int_equal(device_status(bench.device).lost, 0);
    assert_int_equal(stub_events(bench.device, KNURL_FAULT_RECONNECTED, NULL), 1);
    stub_destroy_loop(&bench);
}

TEST_WITH(a_loop_whose_device_is_away_can_be_stopped, stub_by_hand, stub_check) {
    stub.set(0, STUB_BY_HAND, 0.0);
    stub_start(&bench, "touch", 1.0, 1);
    stub.set(STUB_DEFAULT, STUB_ABSENT, 1.0);
    sleep_ms(50.0);
    stub_destroy_loop(&bench);
}

TEST_WITH(a_scheduler_that_stops_calling_is_a_loss_and_nobody_waits_for_ever, stub_by_hand, stub_check) {
    stub.set(0, STUB_BY_HAND, 0.0);
    start(1.0);
    sleep_ms(30.0);
    stub.set(0, STUB_STALL, 1.0);
    const int64_t from = knurl_system_now_ns();
    knurl_loop_stop(bench.loop); /* while it is stalled */
    assert_true(knurl_system_now_ns() - from < INT64_C(10000000000));
    assert_int_equal(stub_loop_state(bench.loop), KNURL_LOOP_LOST);
    stub_destroy_loop(&bench);
    assert_int_equal(stub_events(bench.device, KNURL_FAULT_LOST, NULL), 1);
    const uint64_t ticks = bench.push.ticks;
    stub.set(0, STUB_STALL, 0.0); /* it continues after the loop is destroyed */
    sleep_ms(30.0);
    assert_int_equal(bench.push.ticks, ticks);
}

static void dream_once(uint64_t tick, const knurl_device_sample *sample, double force[3], void *user) {
    if (tick == 10) {
        sleep_ms(1300.0);
    }
    stub_push_force(tick, sample, force, user);
}

TEST_WITH(a_tick_that_takes_longer_than_a_second_is_no_loss, stub_by_hand, stub_check) {
    knurl_loop *loop = NULL;
    stub_push push = {.buttons = 0};
    stub.set(0, STUB_BY_HAND, 0.0);
    SCOPED_DEVICE *device = stub_open("touch");
    knurl_loop_desc desc = stub_loop_desc(device, &push);
    desc.force_callback = dream_once;
    desc.tick_limit = 50;
    assert_int_equal(knurl_loop_create(&desc, &loop), KNURL_OK);
    assert_int_equal(knurl_loop_start(loop), KNURL_OK);
    assert_int_equal(knurl_loop_wait(loop, 15.0), 1);
    assert_int_equal(stub_loop_state(loop), KNURL_LOOP_DONE);
    knurl_loop_destroy(loop);
    assert_int_equal(stub_events(device, KNURL_FAULT_LOST, NULL), 0);
    assert_int_equal(push.ticks, 50);
}

/* --- refusals and other errors --- */

TEST_WITH(a_force_that_is_refused_is_one_fault_a_burst_and_zeroed, stub_by_hand, stub_check) {
    static const double codes[] = {0x0200, 0x0201, 0x0202, 0x0203, 0x0204};
    for (size_t i = 0; i < COUNT_OF(codes); i++) {
        double value = 0.0;
        start(1.0);
        stub.turn(5);
        assert_true(told() == 1.0);
        stub.set(STUB_DEFAULT, STUB_ERROR, codes[i]);
        stub.turn(2);
        assert_true(told() == 0.0);
        stub.turn(500);
        assert_int_equal(stub_events(bench.device, KNURL_FAULT_REFUSED, &value), 1);
        CHECK_SAME(value, codes[i]);
        assert_true(told() == 0.0 && device_status(bench.device).halted == 1 && device_status(bench.device).lost == 0);
        stub.set(STUB_DEFAULT, STUB_ERROR, 0.0);
        stub.turn(99);
        assert_true(told() == 0.0);
        stub.turn(60);
        CHECK_CLOSE(told(), 1.0, 1e-12);
        assert_int_equal(stub_events(bench.device, KNURL_FAULT_RESUMED, NULL), 1);
        stub_close(&bench);
    }
}

TEST_WITH(other_errors_are_counted_and_nothing_else, stub_by_hand, stub_check) {
    start(1.0);
    stub.turn(5);
    const uint64_t before = device_status(bench.device).bad_bytes;
    stub.set(STUB_DEFAULT, STUB_ERROR, 0x0100);
    stub.turn(20);
    stub.set(STUB_DEFAULT, STUB_ERROR, 0x0abc);
    stub.turn(20);
    stub.set(STUB_DEFAULT, STUB_ERROR, 0.0);
    assert_int_equal(device_status(bench.device).bad_bytes - before, 40);
    knurl_device_event event;
    while (knurl_device_next_event(bench.device, &event)) {
        assert_int_equal(event.code, KNURL_FAULT_OVERRUN); /* of turns by hand, at any pace */
    }
    CHECK_CLOSE(told(), 1.0, 1e-12);
}

TEST_WITH(errors_without_end_do_not_hold_up_the_servo_thread, stub_by_hand, stub_check) {
    start(1.0);
    stub.turn(5);
    stub.set(STUB_DEFAULT, STUB_ERRORS, -1.0);
    stub.set(STUB_DEFAULT, STUB_ERROR, 0x0100);
    stub.turn(100);
    stub.set(STUB_DEFAULT, STUB_ERROR, 0.0);
    stub.set(STUB_DEFAULT, STUB_ERRORS, 0.0);
    assert_true(stub.ask(0, STUB_ERRORS_TAKEN) <= 2.0 * 16.0);
    assert_true(bench.push.ticks >= 105);
}

/* --- positions --- */

TEST_WITH(positions_that_are_no_numbers_zero_the_force_until_they_are_again, stub_by_hand, stub_check) {
    start(1.0);
    stub.turn(10);
    stub.set(STUB_DEFAULT, STUB_NAN, 1.0);
    stub.turn(1);
    assert_true(told() == 0.0);
    stub.turn(50);
    assert_int_equal(stub_events(bench.device, KNURL_FAULT_NOT_FINITE, NULL), 1);
    stub.set(STUB_DEFAULT, STUB_NAN, 0.0);
    stub.turn(60);
    CHECK_CLOSE(told(), 1.0, 1e-12);
}

/* By 5 m, which is further than a hand gets in the gap. */
TEST_WITH(a_position_that_jumps_zeroes_the_force_until_it_is_believed, stub_by_hand, stub_check) {
    start(1.0);
    stub.turn(10);
    stub.set(STUB_DEFAULT, STUB_JUMP, 5.0);
    stub.turn(1);
    assert_true(told() == 0.0);
    double value = 0.0;
    stub.turn(60);
    assert_int_equal(stub_events(bench.device, KNURL_FAULT_JUMP, &value), 1);
    CHECK_CLOSE(value, 5.0, 0.001);
    CHECK_CLOSE(told(), 1.0, 1e-12);
}

/* --- calibration --- */

/* As the maker's example does: automatic before inkwell before encoder reset, of those that the device offers. */
TEST_WITH(a_calibration_that_is_out_of_date_is_brought_up_to_date_by_the_best_style, stub_by_hand, stub_check) {
    static const struct {
        double styles, chosen;
    } cases[] = {{1, 1}, {2, 2}, {3, 2}, {4, 4}, {5, 4}, {6, 2}, {7, 2}};
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        stub.reset();
        stub.set(0, STUB_BY_HAND, 1.0);
        stub.set(STUB_DEFAULT, STUB_STYLES, cases[i].styles);
        stub.set(STUB_DEFAULT, STUB_MENDS, 1.0);
        stub.set(STUB_DEFAULT, STUB_CALIBRATION, 0x5001);
        start(1.0);
        stub.turn(999);
        if (stub.ask(STUB_DEFAULT, STUB_LAST_STYLE) != cases[i].chosen || bench.push.ticks == 0) {
            fail_msg("of %g: %g updates, the last with %g; %d ticks", cases[i].styles,
                     stub.ask(STUB_DEFAULT, STUB_UPDATES), stub.ask(STUB_DEFAULT, STUB_LAST_STYLE),
                     (int)bench.push.ticks);
        }
        assert_true(stub.ask(STUB_DEFAULT, STUB_UPDATES) == 1.0);
        assert_int_equal(stub_events(bench.device, KNURL_FAULT_UNCALIBRATED, NULL), 0);
        CHECK_CLOSE(told(), 1.0, 1e-12);
        stub_close(&bench);
    }
}

TEST_WITH(without_a_calibration_there_is_no_force_until_the_stylus_was_in_the_inkwell, stub_by_hand, stub_check) {
    stub.set(STUB_DEFAULT, STUB_STYLES, 4.0); /* inkwell */
    stub.set(STUB_DEFAULT, STUB_CALIBRATION, 0x5002);
    start(1.0);
    stub.turn(350);
    assert_int_equal(stub_events(bench.device, KNURL_FAULT_UNCALIBRATED, NULL), 1);
    assert_true(stub.ask(STUB_DEFAULT, STUB_TOLD_MOST) == 0.0);
    assert_int_equal(bench.push.ticks, 0);
    assert_true(stub.ask(STUB_DEFAULT, STUB_UPDATES) == 0.0); /* the user must act first */
    stub.set(STUB_DEFAULT, STUB_MENDS, 1.0);
    stub.set(STUB_DEFAULT, STUB_CALIBRATION, 0x5001); /* it is in */
    stub.turn(150);
    assert_true(stub.ask(STUB_DEFAULT, STUB_UPDATES) == 1.0);
    CHECK_CLOSE(told(), 1.0, 1e-12);
}

TEST_WITH(a_missing_calibration_is_reported_again_after_a_reopening, stub_by_hand, stub_check) {
    stub.set(STUB_DEFAULT, STUB_STYLES, 4.0); /* inkwell */
    stub.set(STUB_DEFAULT, STUB_CALIBRATION, 0x5002);
    stub_start(&bench, "touch", 1.0, 1);
    stub.turn(10);
    assert_int_equal(stub_events(bench.device, KNURL_FAULT_UNCALIBRATED, NULL), 1);
    stub.set(STUB_DEFAULT, STUB_ABSENT, 1.0);
    stub.turn(10);
    assert_int_equal(device_status(bench.device).lost, 1);
    stub.set(STUB_DEFAULT, STUB_ABSENT, 0.0);
    assert_int_equal(knurl_device_reopen(bench.device), KNURL_OK);
    stub.turn(10);
    assert_int_equal(stub_events(bench.device, KNURL_FAULT_UNCALIBRATED, NULL), 1);
}

TEST_WITH(the_calibration_is_looked_at_every_100_ticks, stub_by_hand, stub_check) {
    stub.set(STUB_DEFAULT, STUB_CALIBRATION, 0x5001);
    start(1.0);
    stub.turn(1000);
    assert_true(stub.ask(STUB_DEFAULT, STUB_UPDATES) == 10.0);
    assert_int_equal(stub_events(bench.device, KNURL_FAULT_UNCALIBRATED, NULL), 1);
}

/* --- nonsense --- */

typedef struct echo {
    knurl_device *device;
    uint64_t calls, felt;
} echo;

static uint32_t play_echo(void *argument) {
    echo *e = argument;
    knurl_device_sample sample;
    double force[3];
    e->calls++;
    if (knurl_device_read(e->device, &sample) == KNURL_OK) {
        e->felt++;
        for (int axis = 0; axis < 3; axis++) {
            force[axis] = -500.0 * sample.position[axis]; /* up to infinity */
        }
        knurl_port_release_halt(e->device);
        (void)knurl_device_write(e->device, force);
    }
    return 1;
}

TEST_WITH(a_million_random_answers_give_no_force_that_is_not_finite_or_too_great, stub_by_hand, stub_check) {
    echo e = {stub_open("touch"), 0, 0};
    e.device->max_speed = 0.0; /* so that jumps do not hold the force back */
    stub.set(STUB_DEFAULT, STUB_RANDOM, 1.0);
    assert_int_equal(knurl_device_start(e.device, 1000.0), KNURL_OK);
    assert_int_equal(e.device->driver->serve(e.device, play_echo, &e), KNURL_OK);
    stub.turn(250000); /* 3 positions, buttons and 1.5 errors each */
    assert_int_equal(e.calls, 250000);
    assert_true(e.felt > 10000);
    assert_true(stub.ask(STUB_DEFAULT, STUB_TOLD_BAD) == 0.0);
    assert_true(stub.ask(STUB_DEFAULT, STUB_TOLD_MOST) > 3.0 && stub.ask(STUB_DEFAULT, STUB_TOLD_MOST) <= 3.3 + 1e-9);
    stub.set(STUB_DEFAULT, STUB_RANDOM, 0.0);
    knurl_device_close(e.device);
}

SUITE_FIXTURES(stub_load, stub_unload)

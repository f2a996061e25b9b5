/* Two Touches at once: HD has one scheduler and one stack of errors for both. SPDX-License-Identifier: MIT */
#include "device/touch/stub.h"

static stub_bench left, right;

static int close_both(void **state) {
    stub_close(&left);
    stub_close(&right);
    return stub_check(state);
}

static void start_left(double force) {
    stub_start(&left, "touch:Left Device", force, 0);
}

static void start_right(double force) {
    stub_start(&right, "touch:Right Device", force, 0);
}

/* With forces of 1 N and 2 N. */
static void start_both(void) {
    start_left(1.0);
    start_right(2.0);
}

TEST_WITH(each_device_gets_its_own_force_from_one_scheduler, stub_by_hand, close_both) {
    start_both();
    stub.turn(50);
    assert_true(stub.ask(0, STUB_STARTS) == 2.0); /* it is stopped while the second one is opened */
    assert_int_equal(left.push.ticks, 50);
    assert_int_equal(right.push.ticks, 50);
    CHECK_CLOSE(stub.ask(STUB_LEFT, STUB_TOLD), 1.0, 1e-12);
    CHECK_CLOSE(stub.ask(STUB_RIGHT, STUB_TOLD), 2.0, 1e-12);
    stub_close(&left);
    assert_true(stub.ask(0, STUB_RUNNING) == 1.0);
    const uint64_t before = right.push.ticks;
    stub.turn(10);
    assert_int_equal(right.push.ticks, before + 10);
    assert_true(stub.ask(STUB_LEFT, STUB_TOLD) == 0.0);
    stub_close(&right);
    assert_true(stub.ask(0, STUB_RUNNING) == 0.0);
}

TEST_WITH(each_device_gives_its_own_position, stub_by_hand, close_both) {
    stub.set(STUB_RIGHT, STUB_JUMP, 0.02);
    start_left(0.0);
    start_right(0.0);
    stub.turn(100);
    CHECK_CLOSE(right.push.from[0] - left.push.from[0], 0.02, 1e-9); /* the same stroke, 20 mm aside */
}

TEST_WITH(one_that_is_lost_leaves_the_other_as_it_is, stub_by_hand, close_both) {
    start_both();
    stub.turn(10);
    stub.set(STUB_LEFT, STUB_ABSENT, 1.0);
    stub.turn(20);
    assert_int_equal(stub_loop_state(left.loop), KNURL_LOOP_LOST);
    assert_int_equal(stub_events(left.device, KNURL_FAULT_LOST, NULL), 1);
    assert_int_equal(right.push.ticks, 30);
    CHECK_CLOSE(stub.ask(STUB_RIGHT, STUB_TOLD), 2.0, 1e-12);
    assert_int_equal(stub_events(right.device, KNURL_FAULT_LOST, NULL), 0);
}

/* More errors than one check removes: the rest appears in the other's frame. */
TEST_WITH(an_error_is_blamed_on_the_device_that_it_is_about, stub_by_hand, close_both) {
    start_both();
    stub.turn(10);
    stub.set(STUB_LEFT, STUB_ERRORS, 40.0);
    stub.set(STUB_LEFT, STUB_ERROR, 0x0200);
    stub.turn(3);
    stub.set(STUB_LEFT, STUB_ERROR, 0.0);
    assert_int_equal(stub_events(left.device, KNURL_FAULT_REFUSED, NULL), 1);
    assert_int_equal(stub_events(right.device, KNURL_FAULT_REFUSED, NULL), 0);
    assert_int_equal(right.push.ticks, 13);
    CHECK_CLOSE(stub.ask(STUB_RIGHT, STUB_TOLD), 2.0, 1e-12);
}

TEST_WITH(a_device_is_opened_once, stub_by_hand, close_both) {
    knurl_device *second = NULL;
    SCOPED_DEVICE *first = stub_open("touch");
    CHECK_REFUSED(knurl_device_open("touch", &second), KNURL_ERROR_SYSTEM, second);
    check_message("in use");
    CHECK_REFUSED(knurl_device_open("touch:Default Device", &second), KNURL_ERROR_SYSTEM, second);
    assert_true(stub.ask(STUB_DEFAULT, STUB_INITIALISED) == 1.0);
}

TEST_WITH(two_loops_run_at_one_rate, stub_by_hand, close_both) {
    start_left(1.0);
    SCOPED_DEVICE *second = stub_open("touch:Right Device");
    (void)knurl_fail(KNURL_OK, "stale message");
    assert_int_equal(knurl_device_start(second, 500.0), KNURL_ERROR_UNSUPPORTED);
    check_message("one scheduler");
    assert_true(stub.ask(0, STUB_RATE) == 1000.0);
    stub_close(&left);
    assert_int_equal(knurl_device_start(second, 500.0), KNURL_OK); /* no other device runs any more */
}

TEST_WITH(a_current_device_that_another_thread_changes_mixes_nothing_up, stub_by_hand, close_both) {
    stub.set(STUB_RIGHT, STUB_JUMP, 0.02);
    start_both();
    stub.set(0, STUB_DRIFTS, 1.0);
    stub.turn(50);
    CHECK_CLOSE(right.push.from[0] - left.push.from[0], 0.02, 0.001);
    CHECK_CLOSE(stub.ask(STUB_LEFT, STUB_TOLD), 1.0, 1e-12);
    CHECK_CLOSE(stub.ask(STUB_RIGHT, STUB_TOLD), 2.0, 1e-12);
    stub.set(0, STUB_DRIFTS, 0.0);
}

/* Opened and closed while the other runs: for ThreadSanitizer, too. HD has one current device. */
TEST_WITH(one_comes_and_goes_while_the_other_runs, stub_by_hand, close_both) {
    stub.set(0, STUB_BY_HAND, 0.0);
    stub.set(STUB_RIGHT, STUB_JUMP, 0.05); /* to tell their positions apart */
    start_left(1.0);
    stub.set(0, STUB_DAWDLES, 1.0);
    for (int turn = 0; turn < 5; turn++) {
        sleep_ms(0.1); /* opens while the other's force is in transit */
        start_right(0.5);
        WAIT_FOR(stub_ticks(&right) >= 20);
        CHECK_CLOSE(stub.ask(STUB_RIGHT, STUB_TOLD_MOST), 0.5, 1e-12); /* its force output was switched on */
        knurl_loop_stop(right.loop);
        assert_int_equal(stub_loop_state(right.loop), KNURL_LOOP_DONE);
        stub_destroy_loop(&right);
        stub_close(&right);
        assert_true(stub.ask(STUB_RIGHT, STUB_TOLD) == 0.0);
        assert_int_equal(stub_loop_state(left.loop), KNURL_LOOP_RUNNING);
    }
    assert_true(stub.ask(STUB_LEFT, STUB_GAPS) == 5.0); /* zero while the other is opened, then a ramp */
    stub_destroy_loop(&left);
    int32_t codes[KNURL_FAULT_RECONNECTED + 1] = {0};
    for (knurl_device_event event; knurl_device_next_event(left.device, &event);) {
        codes[event.code]++;
    }
    assert_int_equal(codes[KNURL_FAULT_RESUMED], 5);
    assert_int_equal(codes[KNURL_FAULT_JUMP] + codes[KNURL_FAULT_LOST], 0);
}

SUITE_FIXTURES(stub_load, stub_unload)

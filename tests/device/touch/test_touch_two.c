/* Two Touches at once: HD has one scheduler and one stack of errors for both. SPDX-License-Identifier: MIT */
#include "device/touch/stub.h"

typedef struct hand {
    knurl_device *device;
    stub_push push;
    knurl_loop *loop;
} hand;

static void start(hand *h, const char *uri, double force) {
    memset(h, 0, sizeof *h);
    h->push.force[1] = force;
    h->device = stub_open(uri);
    const knurl_loop_desc desc = stub_loop_desc(h->device, &h->push);
    h->loop = stub_loop(&desc);
}

static void end(hand *h) {
    stub_end_loop(h->loop);
    knurl_device_close(h->device);
}

/* With forces of 1 N and 2 N. */
static void start_both(hand *left, hand *right) {
    start(left, "touch:Left Device", 1.0);
    start(right, "touch:Right Device", 2.0);
}

static void end_both(hand *left, hand *right) {
    end(left);
    end(right);
}

TEST_WITH(each_device_gets_its_own_force_from_one_scheduler, stub_by_hand, stub_check) {
    hand left;
    hand right;
    start_both(&left, &right);
    stub.turn(50);
    assert_true(stub.ask(0, STUB_STARTS) == 2.0); /* it is stopped while the second one is opened */
    assert_int_equal(left.push.ticks, 50);
    assert_int_equal(right.push.ticks, 50);
    CHECK_CLOSE(stub.ask(STUB_LEFT, STUB_TOLD), 1.0, 1e-12);
    CHECK_CLOSE(stub.ask(STUB_RIGHT, STUB_TOLD), 2.0, 1e-12);
    end(&left);
    assert_true(stub.ask(0, STUB_RUNNING) == 1.0);
    const uint64_t before = right.push.ticks;
    stub.turn(10);
    assert_int_equal(right.push.ticks, before + 10);
    assert_true(stub.ask(STUB_LEFT, STUB_TOLD) == 0.0);
    end(&right);
    assert_true(stub.ask(0, STUB_RUNNING) == 0.0);
}

TEST_WITH(each_device_gives_its_own_position, stub_by_hand, stub_check) {
    hand left;
    hand right;
    stub.set(STUB_RIGHT, STUB_JUMP, 0.02);
    start(&left, "touch:Left Device", 0.0);
    start(&right, "touch:Right Device", 0.0);
    stub.turn(100);
    CHECK_CLOSE(right.push.from[0] - left.push.from[0], 0.02, 1e-9); /* the same stroke, 20 mm aside */
    end_both(&left, &right);
}

TEST_WITH(one_that_is_lost_leaves_the_other_as_it_is, stub_by_hand, stub_check) {
    hand left;
    hand right;
    start_both(&left, &right);
    stub.turn(10);
    stub.set(STUB_LEFT, STUB_ABSENT, 1.0);
    stub.turn(20);
    assert_int_equal(stub_loop_state(left.loop), KNURL_LOOP_LOST);
    assert_int_equal(stub_events(left.device, KNURL_FAULT_LOST, NULL), 1);
    assert_int_equal(right.push.ticks, 30);
    CHECK_CLOSE(stub.ask(STUB_RIGHT, STUB_TOLD), 2.0, 1e-12);
    assert_int_equal(stub_events(right.device, KNURL_FAULT_LOST, NULL), 0);
    end_both(&left, &right);
}

/* More errors than one check removes: the rest appears in the other's frame. */
TEST_WITH(an_error_is_blamed_on_the_device_that_it_is_about, stub_by_hand, stub_check) {
    hand left;
    hand right;
    start_both(&left, &right);
    stub.turn(10);
    stub.set(STUB_LEFT, STUB_ERRORS, 40.0);
    stub.set(STUB_LEFT, STUB_ERROR, 0x0200);
    stub.turn(3);
    stub.set(STUB_LEFT, STUB_ERROR, 0.0);
    assert_int_equal(stub_events(left.device, KNURL_FAULT_REFUSED, NULL), 1);
    assert_int_equal(stub_events(right.device, KNURL_FAULT_REFUSED, NULL), 0);
    assert_int_equal(right.push.ticks, 13);
    CHECK_CLOSE(stub.ask(STUB_RIGHT, STUB_TOLD), 2.0, 1e-12);
    end_both(&left, &right);
}

TEST_WITH(a_device_is_opened_once, stub_by_hand, stub_check) {
    knurl_device *second = NULL;
    SCOPED_DEVICE *first = stub_open("touch");
    CHECK_REFUSED(knurl_device_open("touch", &second), KNURL_ERROR_SYSTEM, second);
    check_message("in use");
    CHECK_REFUSED(knurl_device_open("touch:Default Device", &second), KNURL_ERROR_SYSTEM, second);
    assert_true(stub.ask(STUB_DEFAULT, STUB_INITIALISED) == 1.0);
}

TEST_WITH(two_loops_run_at_one_rate, stub_by_hand, stub_check) {
    hand left;
    start(&left, "touch:Left Device", 1.0);
    SCOPED_DEVICE *right = stub_open("touch:Right Device");
    (void)knurl_fail(KNURL_OK, "stale message");
    assert_int_equal(knurl_device_start(right, 500.0), KNURL_ERROR_UNSUPPORTED);
    check_message("one scheduler");
    assert_true(stub.ask(0, STUB_RATE) == 1000.0);
    end(&left);
    assert_int_equal(knurl_device_start(right, 500.0), KNURL_OK); /* no other device runs any more */
}

TEST_WITH(a_current_device_that_another_thread_changes_mixes_nothing_up, stub_by_hand, stub_check) {
    hand left;
    hand right;
    stub.set(STUB_RIGHT, STUB_JUMP, 0.02);
    start_both(&left, &right);
    stub.set(0, STUB_DRIFTS, 1.0);
    stub.turn(50);
    CHECK_CLOSE(right.push.from[0] - left.push.from[0], 0.02, 0.001);
    CHECK_CLOSE(stub.ask(STUB_LEFT, STUB_TOLD), 1.0, 1e-12);
    CHECK_CLOSE(stub.ask(STUB_RIGHT, STUB_TOLD), 2.0, 1e-12);
    stub.set(0, STUB_DRIFTS, 0.0);
    end_both(&left, &right);
}

/* Opened and closed while the other runs: for ThreadSanitizer, too. HD has one current device. */
TEST_WITH(one_comes_and_goes_while_the_other_runs, stub_by_hand, stub_check) {
    hand left;
    stub.set(0, STUB_BY_HAND, 0.0);
    stub.set(STUB_RIGHT, STUB_JUMP, 0.05); /* to tell their positions apart */
    start(&left, "touch:Left Device", 1.0);
    stub.set(0, STUB_DAWDLES, 1.0);
    for (int turn = 0; turn < 5; turn++) {
        hand right;
        knurl_system_sleep_until_ns(knurl_system_now_ns() + 100000); /* opens while the other's force is in transit */
        start(&right, "touch:Right Device", 0.5);
        for (int waits = 0; waits < 5000 && __atomic_load_n(&right.push.ticks, __ATOMIC_RELAXED) < 20; waits++) {
            knurl_system_sleep_until_ns(knurl_system_now_ns() + 1000000);
        }
        assert_true(__atomic_load_n(&right.push.ticks, __ATOMIC_RELAXED) >= 20);
        CHECK_CLOSE(stub.ask(STUB_RIGHT, STUB_TOLD_MOST), 0.5, 1e-12); /* its force output was switched on */
        knurl_loop_stop(right.loop);
        assert_int_equal(stub_loop_state(right.loop), KNURL_LOOP_DONE);
        knurl_loop_destroy(right.loop);
        knurl_device_close(right.device);
        assert_true(stub.ask(STUB_RIGHT, STUB_TOLD) == 0.0);
        assert_int_equal(stub_loop_state(left.loop), KNURL_LOOP_RUNNING);
    }
    assert_true(stub.ask(STUB_LEFT, STUB_GAPS) == 5.0); /* zero while the other is opened, then a ramp */
    knurl_loop_destroy(left.loop);
    int32_t codes[KNURL_FAULT_RECONNECTED + 1] = {0};
    for (knurl_device_event event; knurl_device_next_event(left.device, &event);) {
        codes[event.code]++;
    }
    assert_int_equal(codes[KNURL_FAULT_RESUMED], 5);
    assert_int_equal(codes[KNURL_FAULT_JUMP] + codes[KNURL_FAULT_LOST], 0);
    knurl_device_close(left.device);
}

SUITE_FIXTURES(stub_load, stub_unload)

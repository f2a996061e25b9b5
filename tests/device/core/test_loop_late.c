/* The loop without heartbeats from its game, and with late ticks. By the test's own clock if possible.
 * SPDX-License-Identifier: MIT */
#include "fault_rig.h"

/* The next event is `code`, with `value` to within `tolerance`. */
static void check_next(int32_t code, double value, double tolerance) {
    knurl_device_event event;
    assert_int_equal(knurl_device_next_event(&r.device, &event), 1);
    assert_int_equal(event.code, code);
    CHECK_CLOSE(event.value, value, tolerance);
}

static int64_t late[100]; /* ns, of each tick: see init_late() */

/* 90 ticks, none of which is late so far. */
static void init_late(void) {
    init();
    memset(late, 0, sizeof late);
    r.late = late;
    r.late_count = COUNT_OF(late);
    r.desc.tick_limit = 90;
}

/* --- heartbeat --- */

/* At tick t, counted from 0: with the last heartbeat before tick s, t - s ticks of 1 ms are silent. */
TEST_WITH(without_a_sign_of_life_the_force_goes_down_by_the_ramp_and_comes_back_by_it, NULL, end_rig) {
    for (int threaded = 0; threaded < 2; threaded++) {
        init();
        r.desc.heartbeat_s = 0.05;
        r.desc.tick_limit = threaded ? 130 : 0;
        rig_go(&r, threaded, 130);
        for (int k = 0; k < 49; k++) {
            CHECK_SAME(r.written[k][1], 1.0L);
        }
        assert_true(r.written[51][1] < 1.0);
        for (int k = 52; k < 80; k++) {
            CHECK_CLOSE(r.written[k][1], fmax(0.0, r.written[k - 1][1] - 1.0 / 21.0), 1e-12);
        }
        for (int k = 73; k < 130; k++) {
            CHECK_SAME(r.written[k][1], 0.0L);
        }
        assert_int_equal(r.calls, 130); /* the callback continues */
        check_next(KNURL_FAULT_HEARTBEAT, 0.0505, 0.00051);
        assert_int_equal(next_code(&r.device, 0), 0);
        if (!threaded) {
            knurl_loop_heartbeat(r.loop);
            rig_step(&r, 40);
            for (int k = 131; k < 170; k++) {
                CHECK_CLOSE(r.written[k][1], fmin(1.0, r.written[k - 1][1] + 1.0 / 21.0), 1e-12);
            }
            CHECK_SAME(r.written[169][1], 1.0L);
            CHECK_EVENTS(KNURL_FAULT_RESUMED);
        }
        rig_destroy(&r);
    }
}

TEST_WITH(with_signs_of_life_in_time_nothing_happens, begin, end_rig) {
    r.desc.heartbeat_s = 0.02;
    rig_create(&r);
    for (int frame = 0; frame < 60; frame++) {
        rig_step(&r, 17); /* 60 frames a second */
        knurl_loop_heartbeat(r.loop);
    }
    for (uint64_t k = 0; k < r.writes; k++) {
        CHECK_SAME(r.written[k][1], 1.0L);
    }
    CHECK_EVENTS(0);
}

TEST_WITH(a_game_that_dies_and_comes_back_half_way_is_taken_from_there, begin, end_rig) {
    r.desc.heartbeat_s = 0.01;
    rig_step(&r, 20);
    const double low = r.written[19][1];
    assert_true(low > 0.2 && low < 0.9);
    knurl_loop_heartbeat(r.loop);
    rig_step(&r, 5);
    for (int k = 20; k < 25; k++) {
        assert_true(fabs(r.written[k][1] - r.written[k - 1][1]) <= 1.0 / 21.0 + 1e-12);
    }
    assert_true(r.written[24][1] > low);
}

/* The force returns with the game's heartbeats, and that is when it is reported. */
TEST_WITH(while_the_game_gives_no_sign_of_life_nothing_is_resumed, begin, end_rig) {
    r.desc.heartbeat_s = 0.02;
    extra.not_ready_from = 100;
    extra.not_ready_to = 110;
    rig_step(&r, 200);
    CHECK_EVENTS(KNURL_FAULT_HEARTBEAT);
    CHECK_SAME(r.written[199][1], 0.0L);
    knurl_loop_heartbeat(r.loop);
    rig_step(&r, 10);
    CHECK_EVENTS(KNURL_FAULT_RESUMED);
    assert_true(r.written[209][1] > 0.3);
}

/* --- lateness --- */

TEST_WITH(a_row_of_late_ticks_is_one_event_with_the_first_ones_lateness, NULL, end_rig) {
    init_late();
    late[10] = 700000; /* of 1 ms; above a half */
    late[11] = late[12] = 900000;
    late[13] = 400000; /* late, but no overrun */
    late[30] = 2300000;
    late[50] = 600000;
    late[51] = 30000000;
    rig_run(&r);
    static const double first[] = {0.0007, 0.0023, 0.0006};
    for (size_t i = 0; i < COUNT_OF(first); i++) {
        check_next(KNURL_FAULT_OVERRUN, first[i], 1e-9);
    }
    assert_int_equal(next_code(&r.device, 0), 0);
    assert_int_equal(rig_stats(&r).overruns, 6);
}

/* The hand moved on between the reads. */
TEST_WITH(after_a_late_tick_a_hand_may_have_moved_on, NULL, end_rig) {
    init_late();
    late[50] = 40000000;
    r.device.max_speed = KNURL_HAND_SPEED;
    extra.speed = 1.0; /* m/s: 40 mm meanwhile */
    rig_run(&r);
    assert_int_equal(rig_stats(&r).absences, 0);
    CHECK_EVENTS(0);
}

/* A process was stopped, or a machine slept: the hand's motion meanwhile is unknown. */
TEST_WITH(a_loop_that_wakes_after_a_gap_zeroes_the_force_tells_it_and_ramps, NULL, end_rig) {
    static const int64_t gaps[] = {51000000, INT64_C(2000000000)};
    for (size_t i = 0; i < COUNT_OF(gaps); i++) {
        init_late();
        late[50] = gaps[i];
        rig_run(&r);
        CHECK_SAME(r.written[49][1], 1.0L);
        check_ramp_up(50);
        check_next(KNURL_FAULT_GAP, 1e-9 * (double)gaps[i], 1e-9);
        CHECK_EVENTS(KNURL_FAULT_RESUMED);
        rig_destroy(&r);
    }
}

TEST_WITH(without_a_ramp_the_first_force_after_a_gap_is_still_zero, NULL, end_rig) {
    init_late();
    late[50] = 100000000;
    r.desc.ramp_s = 0.0;
    rig_run(&r);
    CHECK_SAME(r.written[50][1], 0.0L);
    CHECK_SAME(r.written[51][1], 1.0L);
}

static void stall(rig *self) {
    sleep_ns(150000000);
    self->seen = knurl_port_is_halted(self->desc.device);
}

TEST_WITH(a_haptic_thread_that_stands_still_is_told_by_the_watchdog_and_resumes, NULL, end_rig) {
    init_real();
    r.desc.watchdog_s = 0.05;
    r.special_call = 60;
    r.special = stall;
    rig_create(&r);
    assert_int_equal(knurl_loop_start(r.loop), KNURL_OK);
    const knurl_device_event event = wait_for_event(&r.device, KNURL_FAULT_WATCHDOG);
    assert_true(event.value >= 0.05);
    (void)wait_for_event(&r.device, KNURL_FAULT_RESUMED);
    assert_true(rig_stats(&r).watchdog_trips >= 1);
    knurl_loop_stop(r.loop);
    assert_int_equal(r.seen, 1);
}

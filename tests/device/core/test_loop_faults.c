/* The loop when its device fails: lost, found again, without a position. By the test's own clock if possible. Devices
 * that own the servo thread are in test_serve.c. SPDX-License-Identifier: MIT */
#include "fault_rig.h"

/* --- lost and found --- */

TEST_WITH(a_stepped_loop_looks_for_its_device_every_beat_and_comes_back_by_the_ramp, begin, end_rig) {
    r.desc.reconnect = 1;
    r.reads_left = 70;
    extra.fails = 9;
    rig_step(&r, 200);
    const knurl_loop_stats stats = rig_stats(&r);
    assert_int_equal(stats.state, KNURL_LOOP_RUNNING);
    assert_int_equal(extra.reopens, 10);
    assert_int_equal(stats.absences, 10); /* the beat that noticed it, and nine failed attempts */
    assert_int_equal(stats.ticks, 190);
    assert_int_equal(stats.absent, 0);
    assert_int_equal(r.out_of_order, 0); /* the callback's ticks continue their count */
    assert_int_equal(r.writes, 190);
    CHECK_SAME(r.written[69][1], 1.0L);
    check_ramp_up(70);
    CHECK_EVENTS(KNURL_FAULT_LOST, KNURL_FAULT_RECONNECTED, KNURL_FAULT_RESUMED);
}

TEST_WITH(a_running_loop_looks_for_its_device_four_times_a_second, NULL, end_rig) {
    init_real();
    r.reads_left = 70;
    extra.fails = 2;
    rig_create(&r);
    assert_int_equal(knurl_loop_start(r.loop), KNURL_OK);
    WAIT_FOR(rig_stats(&r).absent);
    wait_for_ticks(150);
    assert_int_equal(rig_stats(&r).state, KNURL_LOOP_RUNNING);
    assert_true(rig_stats(&r).absences >= 200); /* two times a quarter of a second */
    rig_destroy(&r);
    assert_int_equal(extra.reopens, 3);
    assert_true(extra.tried_at[1] - extra.tried_at[0] >= 245000000);
    assert_true(extra.tried_at[2] - extra.tried_at[1] >= 245000000);
    check_ramp_up(70);
    assert_int_equal(r.out_of_order, 0);
    CHECK_EVENTS(KNURL_FAULT_LOST, KNURL_FAULT_RECONNECTED, KNURL_FAULT_RESUMED);
}

TEST_WITH(without_reconnect_a_lost_device_ends_the_loop_and_nobody_looks_for_it, NULL, end_rig) {
    for (int threaded = 0; threaded < 2; threaded++) {
        init_real();
        r.desc.reconnect = 0;
        r.reads_left = 70;
        rig_go(&r, threaded, 1000);
        assert_int_equal(rig_stats(&r).state, KNURL_LOOP_LOST);
        assert_int_equal(rig_stats(&r).ticks, 70);
        assert_int_equal(rig_stats(&r).absences, 1);
        assert_int_equal(extra.reopens, 0);
        CHECK_EVENTS(KNURL_FAULT_LOST);
        rig_check_halted(&r);
        rig_destroy(&r);
    }
}

TEST_WITH(the_tick_limit_counts_ticks_and_not_beats_without_a_device, NULL, end_rig) {
    for (int threaded = 0; threaded < 2; threaded++) {
        init_real();
        r.desc.tick_limit = 100;
        r.reads_left = 70;
        extra.fails = threaded ? 0 : 50;
        rig_create(&r);
        if (threaded) {
            rig_run(&r);
        } else {
            rig_step(&r, 100);
            assert_int_equal(rig_stats(&r).state, KNURL_LOOP_RUNNING);
            rig_step(&r, 100);
        }
        assert_int_equal(rig_stats(&r).state, KNURL_LOOP_DONE);
        assert_int_equal(rig_stats(&r).ticks, 100);
        assert_int_equal(r.calls, 100);
        CHECK_SAME(r.written[r.writes - 1][1], 0.0L);
        rig_destroy(&r);
    }
}

TEST_WITH(a_stop_while_the_device_is_lost_ends_the_loop, NULL, end_rig) {
    for (int threaded = 0; threaded < 2; threaded++) {
        init_real();
        r.reads_left = 70;
        extra.fails = UINT64_MAX;
        rig_create(&r);
        if (threaded) {
            assert_int_equal(knurl_loop_start(r.loop), KNURL_OK);
            WAIT_FOR(rig_stats(&r).absent);
            const int64_t asked = now_ns();
            knurl_loop_stop(r.loop);
            assert_true(now_ns() - asked < 2000000000);
        } else {
            rig_step(&r, 100);
            knurl_loop_request_stop(r.loop);
            rig_step(&r, 1);
        }
        assert_int_equal(rig_stats(&r).state, KNURL_LOOP_DONE);
        assert_int_equal(r.writes, 70);
        rig_check_halted(&r);
        rig_destroy(&r);
    }
}

TEST_WITH(a_loop_can_be_destroyed_in_every_state, NULL, end_rig) {
    enum { IDLE, STOPPED_BEFORE, RUNNING, LOST, STEPPED, STEPPED_LOST, DONE, STATES };
    for (int in = 0; in < STATES; in++) {
        init_real();
        r.desc.watchdog_s = in % 2 ? 0.2 : 0.0;
        r.reads_left = in == LOST || in == STEPPED_LOST ? 20 : UINT64_MAX;
        extra.fails = UINT64_MAX;
        rig_create(&r);
        if (in == STOPPED_BEFORE) {
            knurl_loop_stop(r.loop);
        } else if (in == STEPPED || in == STEPPED_LOST) {
            rig_step(&r, 40);
        } else if (in != IDLE) {
            assert_int_equal(knurl_loop_start(r.loop), KNURL_OK);
            wait_for_ticks(10);
        }
        if (in == LOST) {
            WAIT_FOR(rig_stats(&r).absent);
        } else if (in == DONE) {
            knurl_loop_stop(r.loop);
        }
        rig_destroy(&r);
        const uint64_t reads = r.reads;
        const uint64_t tries = extra.reopens;
        sleep_ns(3000000);
        assert_true(r.reads == reads && extra.reopens == tries); /* no thread uses it any more */
        assert_true(r.writes == 0 || r.writes == 20 || r.written[r.writes - 1][1] == 0.0);
    }
}

/* A loss noticed while writing is handled like one noticed while reading. */
TEST_WITH(a_device_that_is_lost_while_it_is_written_is_halted_and_its_force_resumes, begin, end_rig) {
    r.desc.reconnect = 1;
    r.writes_left = 70;
    rig_step(&r, 71);
    rig_check_halted(&r);
    rig_step(&r, 99);
    check_ramp_up(70);
    CHECK_EVENTS(KNURL_FAULT_LOST, KNURL_FAULT_RECONNECTED, KNURL_FAULT_RESUMED);
}

/* --- beats without a position --- */

TEST_WITH(before_the_first_tick_nothing_is_resumed, begin, end_rig) {
    extra.not_ready_to = 12;
    rig_step(&r, 100);
    assert_int_equal(rig_stats(&r).absences, 12);
    assert_int_equal(rig_stats(&r).ticks, 88);
    CHECK_EVENTS(0);
    check_ramp_up(12);
}

TEST_WITH(a_beat_without_a_position_writes_no_force_and_asks_for_none, begin, end_rig) {
    extra.not_ready_from = 50;
    extra.not_ready_to = 60;
    rig_step(&r, 55);
    assert_int_equal(rig_stats(&r).absent, 1);
    rig_step(&r, 100);
    assert_int_equal(r.calls, 145);
    assert_int_equal(rig_stats(&r).ticks, 145);
    for (int k = 50; k < 60; k++) {
        CHECK_SAME(r.written[k][1], 0.0L);
    }
    check_ramp_up(60);
    CHECK_EVENTS(KNURL_FAULT_RESUMED);
    assert_int_equal(rig_stats(&r).absent, 0);
}

/* A device that does not zero its force by itself plays its last force without end. */
TEST_WITH(at_the_end_the_last_that_is_written_is_no_force_however_it_comes_to_that, NULL, end_rig) {
    for (int i = 0; i < 6; i++) {
        init();
        r.desc.ramp_s = i % 2 ? 0.02 : 0.0;
        r.desc.tick_limit = i < 4 ? 50 : 0;
        extra.not_ready_from = i < 2 ? 1000 : 53; /* in the middle of the ramp, at its start */
        extra.not_ready_from = i >= 4 ? 50 : extra.not_ready_from;
        extra.not_ready_to = 2000;
        rig_step(&r, 50);
        if (i >= 4) {
            knurl_loop_stop(r.loop);
            rig_step(&r, 1);
        }
        assert_int_equal(rig_stats(&r).state, KNURL_LOOP_DONE);
        CHECK_SAME(r.written[49][1], 1.0L);
        CHECK_SAME(r.written[r.writes - 1][1], 0.0L);
        rig_check_halted(&r);
        rig_destroy(&r);
    }
}

static uint32_t halts; /* bit k: the device was halted when the force of tick k was written */

static knurl_result write_and_see_halt(knurl_device *device, const double force[3]) {
    halts |= knurl_port_is_halted(device) << (rig_of(device)->writes % 32);
    return rig_write(device, force);
}

/* An I/O thread still has the old force, which must not be played between the halt and the ramp. */
TEST_WITH(a_halt_lasts_until_the_force_that_begins_the_ramp_is_written, begin, end_rig) {
    extra_driver.write = write_and_see_halt;
    surface_parts parts = surface_plane();
    SCOPED_SCENE *scene = scene_of(&parts);
    halts = 0;
    r.desc.scene = scene;
    r.desc.force_callback = NULL;
    rig_step(&r, 10);
    knurl_device_halt(&r.device);
    rig_step(&r, 10);
    assert_int_equal(halts, 1u << 10);
    assert_int_equal(knurl_port_is_halted(&r.device), 0);
    assert_int_equal(r.writes, 20);
    rig_destroy(&r);
}

TEST_WITH(after_a_halt_the_force_comes_back_by_the_ramp, begin, end_rig) {
    rig_step(&r, 50);
    knurl_device_halt(&r.device);
    rig_step(&r, 50);
    CHECK_SAME(r.written[49][1], 1.0L);
    check_ramp_up(50);
    CHECK_EVENTS(KNURL_FAULT_RESUMED);
}

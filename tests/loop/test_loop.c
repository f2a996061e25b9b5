/* The loop by a clock that the test owns: its rhythm, its counts, its ends and its ramps. Nothing here waits for time.
 * SPDX-License-Identifier: MIT */
#include "support/close.h"
#include "support/rig.h"

#include <stdlib.h>

/* --- rhythm --- */

TEST_WITH(deadlines_are_absolute_and_do_not_drift, NULL, end_rig) {
    static const double rates[] = {100.0, 1000.0, 3000.0, 7000.0, 10000.0};
    for (size_t i = 0; i < COUNT_OF(rates); i++) {
        rig_init(&r);
        r.desc.update_rate_hz = rates[i];
        r.desc.tick_limit = 6000;
        r.desc.ramp_s = 0.0;
        r.busy = (int64_t)(0.3e9 / rates[i]); /* a tick's duration must not shift the next one */
        const int64_t start = r.now;
        rig_run(&r);
        assert_true(r.sleeps >= 6000);
        for (int64_t cycle = 0; cycle < 6000; cycle++) {
            const long double exact = (long double)start + 1e9L * (long double)(cycle + 1) / (long double)rates[i];
            CHECK_CLOSE((long double)r.deadlines[cycle], exact, 1.0L);
        }
        assert_int_equal(rig_stats(&r).overruns, 0);
        rig_destroy(&r);
    }
}

/* Late by so many periods: an overrun above a half; deadlines go on from the next whole period after that. */
TEST_WITH(a_late_tick_is_counted_and_missed_cycles_are_skipped, NULL, end_rig) {
    static const double lateness[] = {0.0, 0.4, 0.49, 0.51, 0.9, 1.1, 1.6, 2.3, 17.5, 1000.25};
    for (size_t i = 0; i < COUNT_OF(lateness); i++) {
        int64_t late[11] = {0};
        late[10] = (int64_t)(lateness[i] * 1e6);
        rig_init(&r);
        const int64_t start = r.now;
        r.late = late;
        r.late_count = COUNT_OF(late);
        r.desc.tick_limit = 40;
        rig_run(&r);
        const knurl_loop_stats stats = rig_stats(&r);
        assert_int_equal(stats.ticks, 40); /* skipped cycles are no ticks */
        assert_int_equal(stats.overruns, lateness[i] > 0.5);
        for (int64_t sleep = 0; sleep < 40; sleep++) {
            const int64_t skipped = sleep > 10 ? (int64_t)lateness[i] : 0;
            assert_int_equal(r.deadlines[sleep], start + (sleep + 1 + skipped) * 1000000);
        }
        rig_destroy(&r);
    }
}

/* However long a force takes: never two ticks within one period of the rhythm. */
TEST_WITH(a_force_that_takes_too_long_makes_no_burst, NULL, end_rig) {
    static const double periods[] = {0.3, 0.99, 1.2, 1.6, 2.3, 5.7, 30.1};
    for (size_t i = 0; i < COUNT_OF(periods); i++) {
        rig_init(&r);
        r.busy = (int64_t)(periods[i] * 1e6);
        r.desc.tick_limit = 100;
        const int64_t start = r.now;
        rig_run(&r);
        for (int tick = 1; tick < 100; tick++) {
            assert_true((r.called_at[tick] - start) / 1000000 > (r.called_at[tick - 1] - start) / 1000000);
        }
        assert_int_equal(rig_stats(&r).ticks, 100);
        assert_true(periods[i] > 1.0 ? rig_stats(&r).overruns >= 30 : rig_stats(&r).overruns == 0);
        rig_destroy(&r);
    }
}

static int ascending(const void *a, const void *b) {
    const int64_t x = *(const int64_t *)a;
    const int64_t y = *(const int64_t *)b;
    return (x > y) - (x < y);
}

TEST_WITH(jitter_is_how_late_the_loop_wakes, begin_rig, end_rig) {
    static int64_t late[2000];
    static int64_t sorted[2000];
    uint64_t random = 11;
    for (size_t i = 0; i < COUNT_OF(late); i++) {
        late[i] = random_integer(&random, 100, i % 50 == 0 ? 400000 : 20000);
    }
    memcpy(sorted, late, sizeof late);
    qsort(sorted, COUNT_OF(sorted), sizeof *sorted, ascending);
    r.late = late;
    r.late_count = COUNT_OF(late);
    r.desc.tick_limit = COUNT_OF(late);
    rig_run(&r);
    const knurl_loop_stats stats = rig_stats(&r);
    CHECK_CLOSE(stats.jitter_ns.p50, (double)sorted[999], 0.03 * (double)sorted[999]);
    CHECK_CLOSE(stats.jitter_ns.p99, (double)sorted[1979], 0.03 * (double)sorted[1979]);
    CHECK_CLOSE(stats.jitter_ns.max, (double)sorted[1999], 0.03 * (double)sorted[1999]);
    assert_int_equal(stats.overruns, 0);
}

TEST_WITH(tick_time_is_that_of_the_callback_alone, begin_rig, end_rig) {
    r.busy = 12345;
    r.desc.tick_limit = 500;
    rig_run(&r);
    const knurl_loop_stats stats = rig_stats(&r);
    CHECK_CLOSE(stats.tick_ns.p50, 12345.0, 0.03 * 12345.0);
    CHECK_CLOSE(stats.tick_ns.p99, 12345.0, 0.03 * 12345.0);
    CHECK_CLOSE(stats.tick_ns.max, 12345.0, 0.03 * 12345.0);
    CHECK_SAME(stats.jitter_ns.max, 0.0L);
}

/* --- ticks --- */

TEST_WITH(the_callback_is_called_once_a_tick_and_what_it_gives_is_written, begin_rig, end_rig) {
    r.desc.tick_limit = 250;
    r.desc.update_rate_hz = 2500.0;
    rig_create(&r);
    assert_int_equal(r.starts, 1);
    CHECK_SAME(r.rate, 2500.0L);
    assert_int_equal(rig_stats(&r).state, KNURL_LOOP_IDLE);
    rig_run(&r);
    assert_int_equal(r.calls, 250);
    assert_int_equal(r.out_of_order, 0);
    for (int tick = 0; tick < 250; tick++) {
        assert_memory_equal(r.written[tick], r.force, sizeof r.force);
    }
    const knurl_loop_stats stats = rig_stats(&r);
    assert_int_equal(stats.state, KNURL_LOOP_DONE);
    assert_int_equal(stats.ticks, 250);
    assert_int_equal(stats.watchdog_trips, 0);
}

TEST_WITH(a_force_that_nobody_sets_is_none, begin_rig, end_rig) {
    memset(r.force, 0, sizeof r.force);
    rig_step(&r, 3);
    for (int axis = 0; axis < 3; axis++) {
        CHECK_SAME(r.written[2][axis], 0.0L);
    }
}

TEST_WITH(stepping_runs_so_many_ticks_and_sleeps_for_none, begin_rig, end_rig) {
    r.desc.tick_limit = 100;
    rig_step(&r, 0);
    assert_int_equal(r.calls, 0);
    rig_step(&r, 30);
    assert_int_equal(r.calls, 30);
    assert_int_equal(rig_stats(&r).state, KNURL_LOOP_RUNNING);
    rig_step(&r, 1000);
    assert_int_equal(r.calls, 100);
    assert_int_equal(rig_stats(&r).state, KNURL_LOOP_DONE);
    rig_step(&r, 1000); /* it is over */
    assert_int_equal(r.calls, 100);
    assert_int_equal(rig_stats(&r).ticks, 100);
    assert_int_equal(r.sleeps, 0);
}

TEST_WITH(without_a_limit_a_loop_goes_on, begin_rig, end_rig) {
    rig_step(&r, 50000);
    assert_int_equal(r.calls, 50000);
    assert_int_equal(rig_stats(&r).state, KNURL_LOOP_RUNNING);
    rig_destroy(&r);
    rig_check_halted(&r);
}

/* --- ends --- */

TEST_WITH(at_the_end_the_force_goes_to_zero_by_a_straight_ramp, NULL, end_rig) {
    static const struct {
        double ramp, rate;
        uint64_t steps;
    } cases[] = {{0.02, 1000.0, 20}, {0.1, 1000.0, 100}, {0.02, 3000.0, 60}, {1.0, 100.0, 100}};
    for (size_t i = 0; i < 2 * COUNT_OF(cases); i++) {
        const uint64_t steps = cases[i / 2].steps;
        rig_init(&r);
        r.desc.ramp_s = cases[i / 2].ramp;
        r.desc.update_rate_hz = cases[i / 2].rate;
        r.desc.tick_limit = 30;
        rig_go(&r, i % 2, 30);
        assert_in_range(r.writes, 30 + steps - 1, 30 + steps + 1);
        for (uint64_t k = 30; k < r.writes; k++) {
            CHECK_CLOSE(r.written[k][1], 1.0 - (double)(k - 29) / (double)(r.writes - 30), 1e-12);
        }
        CHECK_SAME(r.written[r.writes - 1][1], 0.0L);
        assert_int_equal(r.calls, 30); /* the callback is not called any more */
        assert_int_equal(rig_stats(&r).ticks, 30);
        rig_check_halted(&r);
        rig_destroy(&r);
    }
}

/* "s from full force to none": force beyond the motors' limit does not count. */
TEST_WITH(the_ramp_begins_at_what_was_played_not_at_what_was_asked_for, begin_rig, end_rig) {
    r.force[1] = 40.0; /* of 2 N */
    r.desc.tick_limit = 10;
    rig_step(&r, 10);
    CHECK_CLOSE(r.written[9][1], 2.0, 1e-12);
    for (uint64_t k = 10; k < r.writes; k++) {
        CHECK_CLOSE(r.written[k - 1][1] - r.written[k][1], 2.0 / (double)(r.writes - 10), 1e-12);
    }
}

TEST_WITH(without_a_ramp_the_force_is_zeroed_at_once, begin_rig, end_rig) {
    r.desc.ramp_s = 0.0;
    r.desc.tick_limit = 10;
    rig_step(&r, 10);
    assert_in_range(r.writes, 10, 11);
    rig_check_halted(&r);
}

static void give_nan(rig *self) {
    self->force[0] = NAN;
}

TEST_WITH(a_force_that_is_not_finite_is_played_as_none_and_ends_as_none, begin_rig, end_rig) {
    r.special_call = 4;
    r.special = give_nan;
    r.desc.tick_limit = 10;
    rig_step(&r, 10);
    for (uint64_t k = 5; k < r.writes; k++) {
        for (int axis = 0; axis < 3; axis++) {
            CHECK_SAME(r.written[k][axis], 0.0L);
        }
    }
}

/* A device that no longer answers cannot be ramped down: its force is zeroed. */
TEST_WITH(a_lost_device_ends_the_loop_with_its_force_zeroed, NULL, end_rig) {
    for (int i = 0; i < 4; i++) {
        const int threaded = i % 2;
        rig_init(&r);
        r.reads_left = i < 2 ? 70 : UINT64_MAX;
        r.writes_left = i < 2 ? UINT64_MAX : 70;
        rig_go(&r, threaded, 1000);
        assert_int_equal(rig_stats(&r).state, KNURL_LOOP_LOST);
        assert_in_range(rig_stats(&r).ticks, 70, 71); /* the tick whose force could not be written may count */
        assert_int_equal(r.writes, 70);
        rig_check_halted(&r);
        knurl_loop_stop(r.loop); /* no hang */
        assert_int_equal(knurl_loop_wait(r.loop, 0.0), 1);
        assert_int_equal(rig_stats(&r).state, KNURL_LOOP_LOST);
        rig_destroy(&r);
    }
}

TEST_WITH(a_device_that_is_lost_in_the_ramp_ends_it, begin_rig, end_rig) {
    r.desc.tick_limit = 50;
    r.writes_left = 55;
    rig_run(&r);
    assert_int_equal(r.writes, 55);
    rig_check_halted(&r);
}

/* --- states --- */

TEST_WITH(a_stop_before_the_start_means_that_it_ends_at_once, NULL, end_rig) {
    for (int threaded = 0; threaded < 2; threaded++) {
        rig_init(&r);
        rig_create(&r);
        assert_int_equal(knurl_loop_wait(r.loop, 5.0), 1); /* it is not running */
        knurl_loop_stop(r.loop);
        knurl_loop_stop(r.loop);
        rig_go(&r, threaded, 1000);
        assert_int_equal(rig_stats(&r).state, KNURL_LOOP_DONE);
        assert_int_equal(rig_stats(&r).ticks, 0);
        assert_int_equal(r.calls, 0);
        rig_destroy(&r);
    }
}

TEST_WITH(a_loop_runs_once_and_in_one_way, begin_rig, end_rig) {
    char nothing = 0;
    r.desc.tick_limit = 10;
    rig_run(&r);
    CHECK_REFUSED(knurl_loop_start(r.loop), KNURL_ERROR_STATE, nothing);
    CHECK_REFUSED(knurl_loop_step(r.loop, 1), KNURL_ERROR_STATE, nothing);
    assert_int_equal(r.calls, 10);
    rig_destroy(&r);
    rig_step(&r, 1);
    CHECK_REFUSED(knurl_loop_start(r.loop), KNURL_ERROR_STATE, nothing);
    rig_destroy(&r);
    knurl_loop_destroy(NULL);
}

static void stop_now(rig *self) {
    knurl_loop_stop(self->loop);
    self->seen = 1;
}

TEST_WITH(a_stop_from_a_callback_only_asks_and_its_tick_is_the_last, NULL, end_rig) {
    for (int threaded = 0; threaded < 2; threaded++) {
        rig_init(&r);
        r.special_call = 5;
        r.special = stop_now;
        rig_go(&r, threaded, 1000);
        assert_int_equal(r.seen, 1);
        assert_int_equal(r.calls, 6);
        assert_int_equal(rig_stats(&r).ticks, 6);
        assert_int_equal(rig_stats(&r).state, KNURL_LOOP_DONE);
        CHECK_SAME(r.written[5][1], 1.0L); /* that tick's force is written; then the ramp */
        CHECK_SAME(r.written[r.writes - 1][1], 0.0L);
        rig_destroy(&r);
    }
}

TEST_WITH(a_stepped_loop_that_is_asked_to_stop_ends_in_its_next_step, begin_rig, end_rig) {
    rig_step(&r, 10);
    knurl_loop_request_stop(r.loop);
    knurl_loop_stop(r.loop);
    rig_step(&r, 10);
    assert_int_equal(r.calls, 10);
    assert_int_equal(rig_stats(&r).state, KNURL_LOOP_DONE);
    CHECK_SAME(r.written[r.writes - 1][1], 0.0L);
}

TEST_WITH(destroying_a_loop_that_is_being_stepped_takes_the_force_away, begin_rig, end_rig) {
    rig_step(&r, 10);
    rig_destroy(&r);
    CHECK_SAME(r.written[r.writes - 1][1], 0.0L);
    rig_check_halted(&r);
}

TEST_WITH(a_new_loop_on_a_halted_device_plays, begin_rig, end_rig) {
    knurl_device_halt(&r.device);
    rig_step(&r, 100);
    CHECK_SAME(r.written[99][1], 1.0L);
}

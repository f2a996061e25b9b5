/* The loop among threads, on virtual time: stops from anywhere, the watchdog, statistics while it runs, memory.
 * SPDX-License-Identifier: MIT */
#include "support/close.h"
#include "support/rig.h"
#include "support/wait.h"

#include "base/system.h"

#include <stdio.h>
#include <stdlib.h>

static double seconds_now(void) {
    return 1e-9 * (double)knurl_system_now_ns();
}

/* A rig with the system's clock and without a watchdog. */
static void init_real(void) {
    rig_init(&r);
    r.desc.clock = NULL;
    r.desc.watchdog_s = 0.0;
}

static int begin_real(void **state) {
    (void)state;
    init_real();
    return 0;
}

static void wait_for_ticks(uint64_t ticks) {
    WAIT_FOR(rig_stats(&r).ticks >= ticks);
}

static void stop_from_thread(void *loop) {
    knurl_loop_stop(loop);
}

static knurl_thread *start_a_stop(void) {
    knurl_thread *thread = knurl_system_start_thread(stop_from_thread, r.loop, (size_t)256 * 1024);
    assert_non_null(thread);
    return thread;
}

/* --- memory --- */

/* kB of this process that are locked into RAM, or -1 if unknown. */
static long locked_kb(void) {
    char line[256];
    long kb = -1;
    FILE *status = fopen("/proc/self/status", "r");
    while (status && fgets(line, sizeof line, status)) {
        if (strncmp(line, "VmLck:", 6) == 0) {
            kb = strtol(line + 6, NULL, 10);
        }
    }
    if (status) {
        (void)fclose(status);
    }
    return kb;
}

/* The first test: memory that an earlier one left locked would hide a fault. */
TEST_WITH(what_was_locked_is_unlocked_when_it_is_given_back, NULL, end_rig) {
    const long before = locked_kb();
    for (int turn = 0; turn < 5; turn++) {
        init_real();
        r.desc.tick_limit = 5;
        rig_run(&r);
        rig_destroy(&r);
        assert_true(locked_kb() <= before); /* the pages are the host's again */
    }
}

TEST_WITH(only_the_loops_own_memory_and_stack_are_locked, begin_real, end_rig) {
    static unsigned char hosts[8 * 1024 * 1024];
    memset(hosts, 1, sizeof hosts);
    const long before = locked_kb();
    if (before < 0) {
        print_message("skipped: no /proc to read what is locked from\n");
        skip();
    }
    rig_create(&r);
    assert_int_equal(knurl_loop_start(r.loop), KNURL_OK);
    wait_for_ticks(10);
    assert_true(locked_kb() - before < 1024);
    rig_destroy(&r);
    assert_int_equal(hosts[sizeof hosts - 1], 1);
}

/* --- the system's clock --- */

TEST_WITH(half_a_second_at_1_khz_is_500_ticks_and_the_ramp, begin_real, end_rig) {
    r.desc.watchdog_s = 1.0;
    r.desc.tick_limit = 500;
    rig_create(&r);
    const double start = seconds_now();
    rig_run(&r);
    CHECK_CLOSE(seconds_now() - start, 0.52, 0.0005 + 1e-9); /* knurl_loop_wait() polls every half millisecond */
    const knurl_loop_stats stats = rig_stats(&r);
    assert_int_equal(stats.state, KNURL_LOOP_DONE);
    assert_int_equal(stats.ticks, 500);
    assert_int_equal(r.calls, 500);
    assert_int_equal(r.out_of_order, 0);
    assert_int_equal(r.writes, 520); /* and the ramp's */
    assert_int_equal(stats.overruns, 0);
    CHECK_SAME(stats.jitter_ns.max, 0.0L);
}

TEST_WITH(waiting_gives_up_after_its_time, begin_real, end_rig) {
    rig_create(&r);
    assert_int_equal(knurl_loop_start(r.loop), KNURL_OK);
    const double start = seconds_now();
    assert_int_equal(knurl_loop_wait(r.loop, 0.05), 0);
    assert_true(seconds_now() - start >= 0.05);
    assert_int_equal(knurl_loop_wait(r.loop, 0.0), 0);
    assert_int_equal(knurl_loop_wait(r.loop, -1.0), 0);
    assert_int_equal(rig_stats(&r).state, KNURL_LOOP_RUNNING);
}

TEST_WITH(statistics_and_snapshots_can_be_read_while_it_runs, begin_real, end_rig) {
    r.desc.update_rate_hz = 10000.0;
    r.desc.tick_limit = 3000;
    rig_create(&r);
    assert_int_equal(knurl_loop_start(r.loop), KNURL_OK);
    uint64_t last = 0;
    knurl_loop_stats stats;
    const double give_up = seconds_now() + 10.0;
    do {
        stats = rig_stats(&r);
        assert_true(stats.ticks >= last);
        assert_true(stats.overruns <= stats.ticks + 1);
        assert_true(stats.state == KNURL_LOOP_RUNNING || stats.state == KNURL_LOOP_DONE);
        assert_true(stats.jitter_ns.p50 >= 0.0 && stats.tick_ns.max >= 0.0);
        last = stats.ticks;
        sleep_ms(0.03);
    } while (stats.state == KNURL_LOOP_RUNNING && seconds_now() < give_up);
    assert_int_equal(stats.state, KNURL_LOOP_DONE);
    assert_int_equal(rig_stats(&r).ticks, 3000);
}

/* --- stops --- */

TEST_WITH(a_stop_from_another_thread_waits_for_the_end, begin_real, end_rig) {
    rig_create(&r);
    assert_int_equal(knurl_loop_start(r.loop), KNURL_OK);
    wait_for_ticks(20);
    knurl_system_join_thread(start_a_stop());
    assert_int_equal(rig_stats(&r).state, KNURL_LOOP_DONE);
    const uint64_t calls = r.calls;
    assert_int_equal(rig_stats(&r).ticks, calls);
    CHECK_SAME(r.written[(r.writes - 1) % RIG_ROOM][1], 0.0L);
    rig_check_halted(&r);
    knurl_loop_stop(r.loop); /* twice is fine */
    sleep_ms(10.0);
    assert_int_equal(r.calls, calls);
}

TEST_WITH(stops_from_several_threads_at_once_all_return, NULL, end_rig) {
    for (int turn = 0; turn < 20; turn++) {
        knurl_thread *threads[4];
        init_real();
        r.desc.ramp_s = 0.002;
        rig_create(&r);
        assert_int_equal(knurl_loop_start(r.loop), KNURL_OK);
        for (size_t i = 0; i < COUNT_OF(threads); i++) {
            threads[i] = start_a_stop();
        }
        knurl_loop_request_stop(r.loop);
        for (size_t i = 0; i < COUNT_OF(threads); i++) {
            knurl_system_join_thread(threads[i]);
        }
        assert_int_equal(rig_stats(&r).state, KNURL_LOOP_DONE);
        rig_destroy(&r);
    }
}

/* Whichever comes first, the loop ends. */
TEST_WITH(a_stop_that_races_with_the_start_ends_it, NULL, end_rig) {
    for (int turn = 0; turn < 50; turn++) {
        init_real();
        r.desc.ramp_s = 0.001;
        rig_create(&r);
        knurl_thread *thread = start_a_stop();
        assert_int_equal(knurl_loop_start(r.loop), KNURL_OK);
        knurl_system_join_thread(thread);
        assert_int_equal(knurl_loop_wait(r.loop, 10.0), 1);
        assert_int_equal(rig_stats(&r).state, KNURL_LOOP_DONE);
        rig_destroy(&r);
    }
}

static void stop_here(rig *self) {
    knurl_loop_stop(self->loop);
    knurl_loop_stop(self->loop);
}

TEST_WITH(a_stop_from_the_callback_ends_a_real_run, begin_real, end_rig) {
    r.special_call = 30;
    r.special = stop_here;
    rig_run(&r);
    assert_int_equal(r.calls, 31);
    assert_int_equal(rig_stats(&r).state, KNURL_LOOP_DONE);
    CHECK_SAME(r.written[r.writes - 1][1], 0.0L);
}

TEST_WITH(destroying_a_running_loop_takes_the_force_away_and_calls_nobody_afterwards, NULL, end_rig) {
    for (int turn = 0; turn < 10; turn++) {
        init_real();
        r.desc.watchdog_s = turn % 2 ? 0.05 : 0.0;
        r.desc.ramp_s = 0.005;
        rig_create(&r);
        assert_int_equal(knurl_loop_start(r.loop), KNURL_OK);
        if (turn > 0) {
            wait_for_ticks((uint64_t)turn);
        }
        rig_destroy(&r);
        const uint64_t calls = r.calls;
        const uint64_t writes = r.writes;
        assert_true(writes == 0 || r.written[writes - 1][1] == 0.0);
        rig_check_halted(&r);
        sleep_ms(3.0);
        assert_true(r.calls == calls && r.writes == writes);
    }
}

TEST_WITH(a_device_that_is_lost_ends_a_real_run, begin_real, end_rig) {
    SCOPED_DEVICE *device = NULL;
    assert_int_equal(knurl_device_open("fake:?lose_at=0.1", &device), KNURL_OK);
    r.desc.device = device;
    rig_run(&r);
    assert_int_equal(rig_stats(&r).state, KNURL_LOOP_LOST);
    assert_int_equal(rig_stats(&r).ticks, 100);
    assert_int_equal(knurl_port_is_halted(device), 1);
    knurl_loop_stop(r.loop);
    rig_destroy(&r);
}

/* --- the watchdog --- */

static void stall(rig *self) {
    sleep_ms(200.0);
    self->seen = knurl_port_is_halted(self->desc.device);
}

TEST_WITH(while_a_callback_stalls_the_watchdog_zeroes_the_force_and_it_comes_back_by_the_ramp, begin_real, end_rig) {
    r.desc.watchdog_s = 0.05;
    r.special_call = 100;
    r.special = stall;
    r.desc.tick_limit = 600;
    rig_run(&r);
    assert_int_equal(r.seen, 1); /* zeroed while the callback stood */
    assert_true(rig_stats(&r).watchdog_trips >= 1);
    assert_int_equal(rig_stats(&r).ticks, 600);
    CHECK_SAME(r.written[100][1], 0.0L); /* a force computed in the stall is not played */
    double best = 0.0;
    for (int tick = 101; tick < 600; tick++) { /* a machine under load may set it off again */
        assert_true(r.written[tick][1] - r.written[tick - 1][1] <= 1.0 / 20.0 + 1e-12);
        best = fmax(best, r.written[tick][1]);
    }
    CHECK_SAME(best, 1.0L);
}

TEST_WITH(without_a_watchdog_the_force_is_zeroed_only_after_the_stall, begin_real, end_rig) {
    r.special_call = 50;
    r.special = stall;
    r.desc.tick_limit = 60;
    rig_run(&r);
    assert_int_equal(r.seen, 0);
    assert_int_equal(rig_stats(&r).watchdog_trips, 0);
    for (int tick = 0; tick < 60; tick++) {
        CHECK_CLOSE(r.written[tick][1], tick <= 50 ? 1.0 : (tick - 51) / 21.0, 1e-12); /* the ramp after a gap */
    }
}

/* A ramp may take a second, and no tick is counted in it: the watchdog must not cut it off. */
TEST_WITH(a_ramp_longer_than_the_watchdogs_patience_is_played_to_its_end, begin_real, end_rig) {
    r.desc.ramp_s = 0.8;
    r.desc.watchdog_s = 0.25;
    r.desc.tick_limit = 50;
    rig_run(&r);
    assert_int_equal(rig_stats(&r).watchdog_trips, 0);
    assert_in_range(r.writes, 849, 851);
    for (uint64_t k = 51; k < r.writes; k++) {
        CHECK_CLOSE(r.written[k - 1][1] - r.written[k][1], 1.0 / 800.0, 1e-5);
    }
    CHECK_SAME(r.written[r.writes - 1][1], 0.0L);
}

TEST_WITH(a_patient_watchdog_does_not_hold_up_the_destruction, begin_real, end_rig) {
    r.desc.watchdog_s = 10.0;
    rig_create(&r);
    assert_int_equal(knurl_loop_start(r.loop), KNURL_OK);
    wait_for_ticks(5);
    knurl_loop_stop(r.loop);
    const double start = seconds_now();
    rig_destroy(&r);
    assert_true(seconds_now() - start < 1.5); /* a quarter of its patience would be 2.5 s */
}

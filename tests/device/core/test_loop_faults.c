/* The loop when something fails: a device that gets lost and comes back, a game that dies, ticks that come late. By the
 * test's own clock where that is possible. Devices that own the servo thread are in test_serve.c.
 * SPDX-License-Identifier: MIT */
#include "home.h"
#include "support/rig.h"
#include "support/scenes.h"

#include "base/vec3.h"

static rig r; /* set up anew by each test */

/* What the rig's device does beyond what every rig does. */
static struct {
    uint64_t reopens;        /* atomic: tries */
    uint64_t fails;          /* tries that fail */
    int64_t tried_at[64];    /* ns, of each */
    uint64_t not_ready_from; /* reads from here to there bring nothing */
    uint64_t not_ready_to;
    double speed; /* m/s along x by the rig's clock; 0: as every rig */
    int64_t start;
} extra;

static knurl_result extra_read(knurl_device *device, knurl_device_sample *sample) {
    rig *self = rig_of(device);
    const knurl_result result = rig_read(device, sample);
    if (result == KNURL_OK && extra.speed > 0.0) {
        sample->position[0] = extra.speed * 1e-9 * (double)(self->now - extra.start);
    }
    return result == KNURL_OK && self->reads > extra.not_ready_from && self->reads <= extra.not_ready_to
               ? KNURL_ERROR_DEVICE_NOT_READY
               : result;
}

static knurl_result extra_reopen(knurl_device *device) {
    rig *self = rig_of(device);
    extra.tried_at[extra.reopens % COUNT_OF(extra.tried_at)] = now_ns();
    knurl_count_up(&extra.reopens);
    if (extra.reopens <= extra.fails) {
        return KNURL_ERROR_DEVICE_LOST;
    }
    self->reads_left = self->writes_left = UINT64_MAX;
    return KNURL_OK;
}

static knurl_driver extra_driver;

static void init(void) {
    memset(&extra, 0, sizeof extra);
    rig_init(&r);
    extra_driver = rig_driver;
    extra_driver.read = extra_read;
    extra_driver.reopen = extra_reopen;
    knurl_device_init(&r.device, &extra_driver);
    extra.start = r.now;
}

static int end_rig(void **state) {
    (void)state;
    rig_destroy(&r);
    return 0;
}

static void init_real(void) {
    init();
    r.desc.clock = NULL;
    r.desc.watchdog_s = 0.0;
    r.desc.reconnect = 1;
}

static void wait_for_ticks(uint64_t ticks) {
    const int64_t until = now_ns() + INT64_C(10000000000);
    while (rig_stats(&r).ticks < ticks && now_ns() < until) {
        sleep_ns(500000);
    }
    assert_true(rig_stats(&r).ticks >= ticks);
}

static void wait_until_absent(void) {
    const int64_t until = now_ns() + INT64_C(10000000000);
    while (!rig_stats(&r).absent && now_ns() < until) {
        sleep_ns(500000);
    }
    assert_int_equal(rig_stats(&r).absent, 1);
}

static int32_t next_event(void) {
    return next_code(&r.device, KNURL_FAULT_OVERRUN);
}

/* The ramp from a write on that came after a halt: none, then a step more each. */
static void check_ramp_up(uint64_t from) {
    for (uint64_t k = 0; k < 30; k++) {
        CHECK_CLOSE(r.written[from + k][1], fmin(1.0, (double)k / 21.0), 1e-12);
    }
}

/* --- lost and found --- */

TEST_WITH(a_stepped_loop_looks_for_its_device_every_beat_and_comes_back_by_the_ramp, NULL, end_rig) {
    init();
    r.desc.reconnect = 1;
    r.reads_left = 70;
    extra.fails = 9;
    rig_create(&r);
    assert_int_equal(knurl_loop_step(r.loop, 200), KNURL_OK);
    const knurl_loop_stats stats = rig_stats(&r);
    assert_int_equal(stats.state, KNURL_LOOP_RUNNING);
    assert_int_equal(extra.reopens, 10);
    assert_int_equal(stats.absences, 10); /* the beat that noticed it, and nine that tried in vain */
    assert_int_equal(stats.ticks, 190);
    assert_int_equal(stats.absent, 0);
    assert_int_equal(r.out_of_order, 0); /* the callback's ticks go on where they were */
    assert_int_equal(r.writes, 190);
    CHECK_SAME(r.written[69][1], 1.0L);
    check_ramp_up(70);
    assert_int_equal(next_event(), KNURL_FAULT_LOST);
    assert_int_equal(next_event(), KNURL_FAULT_RECONNECTED);
    assert_int_equal(next_event(), KNURL_FAULT_RESUMED);
    assert_int_equal(next_event(), 0);
}

TEST_WITH(a_running_loop_looks_for_its_device_four_times_a_second, NULL, end_rig) {
    init_real();
    r.reads_left = 70;
    extra.fails = 2;
    rig_create(&r);
    assert_int_equal(knurl_loop_start(r.loop), KNURL_OK);
    wait_until_absent();
    wait_for_ticks(150);
    assert_int_equal(rig_stats(&r).state, KNURL_LOOP_RUNNING);
    assert_true(rig_stats(&r).absences >= 200); /* two times a quarter of a second */
    rig_destroy(&r);
    assert_int_equal(extra.reopens, 3);
    assert_true(extra.tried_at[1] - extra.tried_at[0] >= 245000000);
    assert_true(extra.tried_at[2] - extra.tried_at[1] >= 245000000);
    check_ramp_up(70);
    assert_int_equal(r.out_of_order, 0);
    assert_int_equal(next_event(), KNURL_FAULT_LOST);
    assert_int_equal(next_event(), KNURL_FAULT_RECONNECTED);
    assert_int_equal(next_event(), KNURL_FAULT_RESUMED);
    assert_int_equal(next_event(), 0);
}

TEST_WITH(without_reconnect_a_lost_device_ends_the_loop_and_nobody_looks_for_it, NULL, end_rig) {
    for (int threaded = 0; threaded < 2; threaded++) {
        init_real();
        r.desc.reconnect = 0;
        r.reads_left = 70;
        rig_create(&r);
        if (threaded) {
            rig_run(&r);
        } else {
            assert_int_equal(knurl_loop_step(r.loop, 1000), KNURL_OK);
        }
        assert_int_equal(rig_stats(&r).state, KNURL_LOOP_LOST);
        assert_int_equal(rig_stats(&r).ticks, 70);
        assert_int_equal(rig_stats(&r).absences, 1);
        assert_int_equal(extra.reopens, 0);
        assert_int_equal(next_event(), KNURL_FAULT_LOST);
        assert_int_equal(next_event(), 0);
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
            assert_int_equal(knurl_loop_step(r.loop, 100), KNURL_OK);
            assert_int_equal(rig_stats(&r).state, KNURL_LOOP_RUNNING);
            assert_int_equal(knurl_loop_step(r.loop, 100), KNURL_OK);
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
            wait_until_absent();
            const int64_t asked = now_ns();
            knurl_loop_stop(r.loop);
            assert_true(now_ns() - asked < 2000000000);
        } else {
            assert_int_equal(knurl_loop_step(r.loop, 100), KNURL_OK);
            knurl_loop_request_stop(r.loop);
            assert_int_equal(knurl_loop_step(r.loop, 1), KNURL_OK);
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
            assert_int_equal(knurl_loop_step(r.loop, 40), KNURL_OK);
        } else if (in != IDLE) {
            assert_int_equal(knurl_loop_start(r.loop), KNURL_OK);
            wait_for_ticks(10);
        }
        if (in == LOST) {
            wait_until_absent();
        } else if (in == DONE) {
            knurl_loop_stop(r.loop);
        }
        rig_destroy(&r);
        const uint64_t reads = r.reads;
        const uint64_t tries = extra.reopens;
        sleep_ns(3000000);
        assert_true(r.reads == reads && extra.reopens == tries); /* nobody goes on with it */
        assert_true(r.writes == 0 || r.writes == 20 || r.written[r.writes - 1][1] == 0.0);
    }
}

/* What is noticed while writing is no other loss than what is noticed while reading. */
TEST_WITH(a_device_that_is_lost_while_it_is_written_is_halted_and_its_force_resumes, NULL, end_rig) {
    init();
    r.desc.reconnect = 1;
    r.writes_left = 70;
    rig_create(&r);
    assert_int_equal(knurl_loop_step(r.loop, 71), KNURL_OK);
    rig_check_halted(&r);
    assert_int_equal(knurl_loop_step(r.loop, 99), KNURL_OK);
    check_ramp_up(70);
    assert_int_equal(next_event(), KNURL_FAULT_LOST);
    assert_int_equal(next_event(), KNURL_FAULT_RECONNECTED);
    assert_int_equal(next_event(), KNURL_FAULT_RESUMED);
    assert_int_equal(next_event(), 0);
}

/* --- beats without a position --- */

TEST_WITH(before_the_first_tick_nothing_is_resumed, NULL, end_rig) {
    init();
    extra.not_ready_to = 12;
    rig_create(&r);
    assert_int_equal(knurl_loop_step(r.loop, 100), KNURL_OK);
    assert_int_equal(rig_stats(&r).absences, 12);
    assert_int_equal(rig_stats(&r).ticks, 88);
    assert_int_equal(next_event(), 0);
    check_ramp_up(12);
}

TEST_WITH(a_beat_without_a_position_writes_no_force_and_asks_for_none, NULL, end_rig) {
    init();
    extra.not_ready_from = 50;
    extra.not_ready_to = 60;
    rig_create(&r);
    assert_int_equal(knurl_loop_step(r.loop, 55), KNURL_OK);
    assert_int_equal(rig_stats(&r).absent, 1);
    assert_int_equal(knurl_loop_step(r.loop, 100), KNURL_OK);
    assert_int_equal(r.calls, 145);
    assert_int_equal(rig_stats(&r).ticks, 145);
    for (int k = 50; k < 60; k++) {
        CHECK_SAME(r.written[k][1], 0.0L);
    }
    check_ramp_up(60);
    assert_int_equal(next_event(), KNURL_FAULT_RESUMED);
    assert_int_equal(next_event(), 0);
    assert_int_equal(rig_stats(&r).absent, 0);
}

/* A device that does not zero its force by itself plays its last force for ever. */
TEST_WITH(at_the_end_the_last_that_is_written_is_no_force_however_it_comes_to_that, NULL, end_rig) {
    for (int i = 0; i < 6; i++) {
        init();
        r.desc.ramp_s = i % 2 ? 0.02 : 0.0;
        r.desc.tick_limit = i < 4 ? 50 : 0;
        extra.not_ready_from = i < 2 ? 1000 : 53; /* in the middle of the ramp, at its beginning */
        extra.not_ready_from = i >= 4 ? 50 : extra.not_ready_from;
        extra.not_ready_to = 2000;
        rig_create(&r);
        assert_int_equal(knurl_loop_step(r.loop, 50), KNURL_OK);
        if (i >= 4) {
            knurl_loop_stop(r.loop);
            assert_int_equal(knurl_loop_step(r.loop, 1), KNURL_OK);
        }
        assert_int_equal(rig_stats(&r).state, KNURL_LOOP_DONE);
        CHECK_SAME(r.written[49][1], 1.0L);
        CHECK_SAME(r.written[r.writes - 1][1], 0.0L);
        rig_check_halted(&r);
        rig_destroy(&r);
    }
}

static uint32_t halts; /* bit k: the device was halted when the force of tick k was about to be written */

static void see_halt(const knurl_tick_output *output, void *user) {
    rig *self = user;
    halts |= knurl_device_is_halted(&self->device) << (output->tick % 32);
}

/* What an I/O thread still has is the force from before: it must not be played between the halt and the ramp. */
TEST_WITH(a_halt_lasts_until_the_force_that_begins_the_ramp_is_written, NULL, end_rig) {
    init();
    surface_parts parts = surface_plane();
    knurl_scene *scene = scene_of(&parts);
    halts = 0;
    r.desc.scene = scene;
    r.desc.force_callback = NULL;
    r.desc.tick_callback = see_halt;
    rig_create(&r);
    assert_int_equal(knurl_loop_step(r.loop, 10), KNURL_OK);
    knurl_device_halt(&r.device);
    assert_int_equal(knurl_loop_step(r.loop, 10), KNURL_OK);
    assert_int_equal(halts, 1u << 10);
    assert_int_equal(knurl_device_is_halted(&r.device), 0);
    rig_destroy(&r);
    knurl_scene_destroy(scene);
}

TEST_WITH(after_a_halt_the_force_comes_back_by_the_ramp, NULL, end_rig) {
    init();
    rig_create(&r);
    assert_int_equal(knurl_loop_step(r.loop, 50), KNURL_OK);
    knurl_device_halt(&r.device);
    assert_int_equal(knurl_loop_step(r.loop, 50), KNURL_OK);
    CHECK_SAME(r.written[49][1], 1.0L);
    check_ramp_up(50);
    assert_int_equal(next_event(), KNURL_FAULT_RESUMED);
    assert_int_equal(next_event(), 0);
}

/* --- heartbeat --- */

/* At tick t, counted from 0: with the last sign before tick s, t - s ticks of 1 ms are silent. */
TEST_WITH(without_a_sign_of_life_the_force_goes_down_by_the_ramp_and_comes_back_by_it, NULL, end_rig) {
    for (int threaded = 0; threaded < 2; threaded++) {
        knurl_device_event event;
        init();
        r.desc.heartbeat_s = 0.05;
        r.desc.tick_limit = threaded ? 130 : 0;
        rig_create(&r);
        if (threaded) {
            rig_run(&r); /* by the test's clock: the same */
        } else {
            assert_int_equal(knurl_loop_step(r.loop, 130), KNURL_OK);
        }
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
        assert_int_equal(r.calls, 130); /* the callback goes on */
        assert_int_equal(knurl_device_next_event(&r.device, &event), 1);
        assert_int_equal(event.code, KNURL_FAULT_HEARTBEAT);
        CHECK_CLOSE(event.value, 0.0505, 0.00051);
        assert_int_equal(knurl_device_next_event(&r.device, &event), 0);
        if (!threaded) {
            knurl_loop_heartbeat(r.loop);
            assert_int_equal(knurl_loop_step(r.loop, 40), KNURL_OK);
            for (int k = 131; k < 170; k++) {
                CHECK_CLOSE(r.written[k][1], fmin(1.0, r.written[k - 1][1] + 1.0 / 21.0), 1e-12);
            }
            CHECK_SAME(r.written[169][1], 1.0L);
            assert_int_equal(next_event(), KNURL_FAULT_RESUMED);
            assert_int_equal(next_event(), 0);
        }
        rig_destroy(&r);
    }
}

TEST_WITH(with_signs_of_life_in_time_nothing_happens, NULL, end_rig) {
    init();
    r.desc.heartbeat_s = 0.02;
    rig_create(&r);
    for (int frame = 0; frame < 60; frame++) {
        assert_int_equal(knurl_loop_step(r.loop, 17), KNURL_OK); /* 60 frames a second */
        knurl_loop_heartbeat(r.loop);
    }
    for (uint64_t k = 0; k < r.writes; k++) {
        CHECK_SAME(r.written[k][1], 1.0L);
    }
    assert_int_equal(next_event(), 0);
}

TEST_WITH(a_game_that_dies_and_comes_back_half_way_is_taken_from_there, NULL, end_rig) {
    init();
    r.desc.heartbeat_s = 0.01;
    rig_create(&r);
    assert_int_equal(knurl_loop_step(r.loop, 20), KNURL_OK);
    const double low = r.written[19][1];
    assert_true(low > 0.2 && low < 0.9);
    knurl_loop_heartbeat(r.loop);
    assert_int_equal(knurl_loop_step(r.loop, 5), KNURL_OK);
    for (int k = 20; k < 25; k++) {
        assert_true(fabs(r.written[k][1] - r.written[k - 1][1]) <= 1.0 / 21.0 + 1e-12);
    }
    assert_true(r.written[24][1] > low);
}

/* The force comes back when the game does, and that is when it is told. */
TEST_WITH(while_the_game_gives_no_sign_of_life_nothing_is_resumed, NULL, end_rig) {
    init();
    r.desc.heartbeat_s = 0.02;
    extra.not_ready_from = 100;
    extra.not_ready_to = 110;
    rig_create(&r);
    assert_int_equal(knurl_loop_step(r.loop, 200), KNURL_OK);
    assert_int_equal(next_event(), KNURL_FAULT_HEARTBEAT);
    assert_int_equal(next_event(), 0);
    CHECK_SAME(r.written[199][1], 0.0L);
    knurl_loop_heartbeat(r.loop);
    assert_int_equal(knurl_loop_step(r.loop, 10), KNURL_OK);
    assert_int_equal(next_event(), KNURL_FAULT_RESUMED);
    assert_int_equal(next_event(), 0);
    assert_true(r.written[209][1] > 0.3);
}

/* --- lateness --- */

TEST_WITH(a_row_of_late_ticks_is_one_event_with_the_first_ones_lateness, NULL, end_rig) {
    static int64_t late[100];
    memset(late, 0, sizeof late);
    late[10] = 700000; /* of 1 ms; above a half */
    late[11] = late[12] = 900000;
    late[13] = 400000; /* late, but no overrun */
    late[30] = 2300000;
    late[50] = 600000;
    late[51] = 30000000;
    init();
    r.late = late;
    r.late_count = COUNT_OF(late);
    r.desc.tick_limit = 90;
    rig_create(&r);
    rig_run(&r);
    static const double first[] = {0.0007, 0.0023, 0.0006};
    for (size_t i = 0; i < COUNT_OF(first); i++) {
        knurl_device_event event;
        assert_int_equal(knurl_device_next_event(&r.device, &event), 1);
        assert_int_equal(event.code, KNURL_FAULT_OVERRUN);
        CHECK_CLOSE(event.value, first[i], 1e-9);
    }
    assert_int_equal(next_code(&r.device, 0), 0);
    assert_int_equal(rig_stats(&r).overruns, 6);
}

/* While nobody read, the hand went on. */
TEST_WITH(after_a_late_tick_a_hand_may_have_moved_on, NULL, end_rig) {
    static int64_t late[100];
    memset(late, 0, sizeof late);
    late[50] = 40000000;
    init();
    r.device.max_speed = KNURL_HAND_SPEED;
    extra.speed = 1.0; /* m/s: 40 mm meanwhile */
    r.late = late;
    r.late_count = COUNT_OF(late);
    r.desc.tick_limit = 90;
    rig_create(&r);
    rig_run(&r);
    assert_int_equal(rig_stats(&r).absences, 0);
    assert_int_equal(next_event(), 0);
}

/* A process that was stopped, or a machine that slept: nobody knows what the hand has done meanwhile. */
TEST_WITH(a_loop_that_wakes_after_a_gap_zeroes_the_force_tells_it_and_ramps, NULL, end_rig) {
    static const int64_t gaps[] = {51000000, INT64_C(2000000000)};
    for (size_t i = 0; i < COUNT_OF(gaps); i++) {
        static int64_t late[100];
        knurl_device_event event;
        memset(late, 0, sizeof late);
        late[50] = gaps[i];
        init();
        r.late = late;
        r.late_count = COUNT_OF(late);
        r.desc.tick_limit = 90;
        rig_create(&r);
        rig_run(&r);
        CHECK_SAME(r.written[49][1], 1.0L);
        check_ramp_up(50);
        assert_int_equal(knurl_device_next_event(&r.device, &event), 1);
        assert_int_equal(event.code, KNURL_FAULT_GAP);
        CHECK_CLOSE(event.value, 1e-9 * (double)gaps[i], 1e-9);
        assert_int_equal(next_event(), KNURL_FAULT_RESUMED);
        assert_int_equal(next_event(), 0);
        rig_destroy(&r);
    }
}

TEST_WITH(without_a_ramp_the_first_force_after_a_gap_is_still_zero, NULL, end_rig) {
    static int64_t late[100];
    memset(late, 0, sizeof late);
    late[50] = 100000000;
    init();
    r.desc.ramp_s = 0.0;
    r.late = late;
    r.late_count = COUNT_OF(late);
    r.desc.tick_limit = 90;
    rig_create(&r);
    rig_run(&r);
    CHECK_SAME(r.written[50][1], 0.0L);
    CHECK_SAME(r.written[51][1], 1.0L);
}

static void stall(rig *self) {
    sleep_ns(150000000);
    self->seen = knurl_device_is_halted(self->desc.device);
}

TEST_WITH(a_haptic_thread_that_stands_still_is_told_by_the_watchdog_and_resumes, NULL, end_rig) {
    knurl_device_event event = {0};
    init_real();
    r.desc.watchdog_s = 0.05;
    r.special_call = 60;
    r.special = stall;
    rig_create(&r);
    assert_int_equal(knurl_loop_start(r.loop), KNURL_OK);
    assert_int_equal(wait_for_event(&r.device, KNURL_FAULT_WATCHDOG, &event), 1);
    assert_true(event.value >= 0.05);
    assert_int_equal(wait_for_event(&r.device, KNURL_FAULT_RESUMED, &event), 1);
    assert_true(rig_stats(&r).watchdog_trips >= 1);
    knurl_loop_stop(r.loop);
    assert_int_equal(r.seen, 1);
}

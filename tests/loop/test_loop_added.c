/* A game's additions to the surfaces' forces: gain, force, vibration; and their bounds.
 * SPDX-License-Identifier: MIT */
#include "loop/bench.h"

/* Below the wall's surface, m: 2 N of 400 N/m. */
#define DEPTH 0.005

/* Above it: nothing is touched. */
#define FREE (-0.02)

/* N that a force may grow by in a tick: 3.3 N within 5 ms. */
#define SLEW (3.3 / 5.0)

static void begin(double depth) {
    bench_open(depth);
    step(60);
}

TEST_WITH(a_gain_scales_what_is_sent_and_is_reached_by_the_ramp, NULL, end_bench) {
    begin(DEPTH);
    CHECK_CLOSE(written(0)[1], 2.0, 1e-9);
    assert_int_equal(knurl_loop_set_gain(b.loop, 0.25), KNURL_OK);
    step(1);
    CHECK_CLOSE(written(0)[1], 2.0 * (1.0 - 1.0 / 21.0), 1e-9); /* 20 ms and a tick */
    step(30);
    CHECK_CLOSE(written(0)[1], 0.5, 1e-9);
    CHECK_CLOSE(bench_tick().force[1], 0.5, 1e-9);
    assert_int_equal(bench_tick().contacts, 1);
    assert_int_equal(knurl_loop_set_gain(b.loop, 1.0), KNURL_OK);
    step(30);
    CHECK_CLOSE(written(0)[1], 2.0, 1e-9);
}

TEST_WITH(a_gain_of_0_is_no_force_at_all, NULL, end_bench) {
    static const double force[3] = {1.0, 0.0, 0.0};
    begin(DEPTH);
    assert_int_equal(knurl_loop_set_gain(b.loop, 0.0), KNURL_OK);
    assert_int_equal(knurl_loop_set_force(b.loop, force), KNURL_OK);
    step(40);
    CHECK_VECTOR(written(0), 0.0, 0.0, 0.0, 0.0);
}

TEST_WITH(a_games_force_is_added_and_grows_by_the_slew_limit, NULL, end_bench) {
    static const double force[3] = {0.0, 0.0, 1.5};
    static const double none[3] = {0.0, 0.0, 0.0};
    begin(FREE);
    CHECK_VECTOR(written(0), 0.0, 0.0, 0.0, 0.0);
    assert_int_equal(knurl_loop_set_force(b.loop, force), KNURL_OK);
    step(1);
    CHECK_VECTOR(written(0), 0.0, 0.0, SLEW, 1e-12);
    step(1);
    CHECK_VECTOR(written(0), 0.0, 0.0, 2.0 * SLEW, 1e-12);
    step(1);
    CHECK_VECTOR(written(0), 0.0, 0.0, 1.5, 1e-12);
    CHECK_VECTOR(bench_tick().force, 0.0, 0.0, 1.5, 1e-12);
    assert_int_equal(bench_tick().contacts, 0);
    assert_int_equal(knurl_loop_set_force(b.loop, none), KNURL_OK);
    step(1);
    CHECK_VECTOR(written(0), 0.0, 0.0, 0.0, 0.0);
}

TEST_WITH(wall_and_game_together_are_shortened_to_what_the_motors_can_do, NULL, end_bench) {
    static const double force[3] = {0.0, 300.0, 400.0};
    begin(DEPTH);
    assert_int_equal(knurl_loop_set_force(b.loop, force), KNURL_OK);
    step(20);
    CHECK_CLOSE(written_now(), 3.3, 1e-9);
    step(60000); /* a minute: the motors hold 0.88 N for ever */
    assert_true(written_now() < 1.5);
    assert_true(bench_counts().heat <= 1.0);
}

TEST_WITH(a_games_force_goes_with_its_sign_of_life, NULL, end_bench) {
    static const double force[3] = {0.0, 0.0, 1.0};
    bench_open(FREE);
    b.desc.heartbeat_s = 0.05;
    bench_create();
    assert_int_equal(knurl_loop_set_force(b.loop, force), KNURL_OK);
    knurl_loop_heartbeat(b.loop);
    step(40);
    CHECK_VECTOR(written(0), 0.0, 0.0, 1.0, 1e-12);
    step(40);
    CHECK_VECTOR(written(0), 0.0, 0.0, 0.0, 0.0);
}

TEST_WITH(a_paused_loop_sends_none_of_a_games_force, NULL, end_bench) {
    static const double force[3] = {0.0, 0.0, 1.0};
    begin(FREE);
    assert_int_equal(knurl_loop_set_force(b.loop, force), KNURL_OK);
    knurl_loop_pause(b.loop);
    step(40);
    CHECK_VECTOR(written(0), 0.0, 0.0, 0.0, 0.0);
}

/* 250 Hz of 1 N at 1 kHz, 4 ticks a period: 1, 1, -1, -1 (Algorithm 2), from the first tick to the last as it is: its
 * steps of 2 N are its own. */
TEST_WITH(a_vibration_is_played_to_the_bit_along_its_direction, NULL, end_bench) {
    static const double along[3] = {0.0, 0.0, 5.0};
    begin(FREE);
    assert_int_equal(knurl_loop_vibrate(b.loop, KNURL_WAVE_T3, 250.0, 1.0, along, 0.02), KNURL_OK);
    for (int k = 0; k < 20; k++) {
        step(1);
        CHECK_VECTOR(written(0), 0.0, 0.0, k % 4 < 2 ? 1.0 : -1.0, 1e-12);
    }
    step(1);
    CHECK_VECTOR(written(0), 0.0, 0.0, 0.0, 0.0);
}

/* 3 ticks a period: 1 + 2 ticks of heights whose sum is 0; 0.01 s are 10 ticks, of which 12 make whole events. */
TEST_WITH(a_vibration_of_T3_ends_after_a_whole_event, NULL, end_bench) {
    static const double along[3] = {1.0, 0.0, 0.0};
    double impulse = 0.0;
    uint64_t ticks = 0;
    begin(FREE);
    assert_int_equal(knurl_loop_vibrate(b.loop, KNURL_WAVE_T3, 1000.0 / 3.0, 1.0, along, 0.01), KNURL_OK);
    for (int k = 0; k < 30; k++) {
        step(1);
        impulse += written(0)[0];
        ticks += written(0)[0] != 0.0;
    }
    assert_int_equal(ticks, 12);
    CHECK_CLOSE(impulse, 0.0, 1e-9);
}

TEST_WITH(a_vibration_of_no_time_ends_the_one_that_plays, NULL, end_bench) {
    static const double along[3] = {0.0, 0.0, 1.0};
    begin(FREE);
    assert_int_equal(knurl_loop_vibrate(b.loop, KNURL_WAVE_T1, 100.0, 1.0, along, 10.0), KNURL_OK);
    step(7);
    assert_true(written_now() > 0.9);
    assert_int_equal(knurl_loop_vibrate(b.loop, KNURL_WAVE_T1, 100.0, 1.0, along, 0.0), KNURL_OK);
    step(1);
    CHECK_VECTOR(written(0), 0.0, 0.0, 0.0, 0.0);
}

TEST_WITH(numbers_that_are_none_are_refused_and_change_nothing, NULL, end_bench) {
    static const double nonsense[3] = {1.0, NAN, 0.0};
    static const double much[3] = {0.0, 1e300, 0.0};
    static const double none[3] = {0.0, 0.0, 0.0};
    static const double up[3] = {0.0, 1.0, 0.0};
    begin(DEPTH);
    assert_int_equal(knurl_loop_set_gain(b.loop, NAN), KNURL_ERROR_ARGUMENT);
    assert_int_equal(knurl_loop_set_gain(b.loop, 1.5), KNURL_ERROR_ARGUMENT);
    assert_int_equal(knurl_loop_set_gain(b.loop, -0.1), KNURL_ERROR_ARGUMENT);
    assert_int_equal(knurl_loop_set_force(b.loop, nonsense), KNURL_ERROR_ARGUMENT);
    assert_int_equal(knurl_loop_set_force(b.loop, much), KNURL_ERROR_ARGUMENT);
    assert_int_equal(knurl_loop_vibrate(b.loop, KNURL_WAVE_T3, 100.0, 1.0, none, 1.0), KNURL_ERROR_ARGUMENT);
    assert_int_equal(knurl_loop_vibrate(b.loop, KNURL_WAVE_T3, 100.0, 1.0, nonsense, 1.0), KNURL_ERROR_ARGUMENT);
    assert_int_equal(knurl_loop_vibrate(b.loop, KNURL_WAVE_T3, 100.0, 1.0, much, 1.0), KNURL_ERROR_ARGUMENT);
    assert_int_equal(knurl_loop_vibrate(b.loop, KNURL_WAVE_T3, 501.0, 1.0, up, 1.0), KNURL_ERROR_ARGUMENT);
    assert_int_equal(knurl_loop_vibrate(b.loop, KNURL_WAVE_T3, 100.0, NAN, up, 1.0), KNURL_ERROR_ARGUMENT);
    assert_int_equal(knurl_loop_vibrate(b.loop, KNURL_WAVE_T3, 100.0, 1.0, up, -1.0), KNURL_ERROR_ARGUMENT);
    assert_int_equal(knurl_loop_vibrate(b.loop, 9, 100.0, 1.0, up, 1.0), KNURL_ERROR_UNKNOWN);
    step(1);
    CHECK_VECTOR(written(0), 0.0, 2.0, 0.0, 1e-9);
}

TEST_WITH(a_force_callback_adds_forces_itself_and_has_the_gain, NULL, end_bench) {
    static double right[3] = {1.0, 0.0, 0.0};
    static const double up[3] = {0.0, 1.0, 0.0};
    bench_open(FREE);
    bench_create_callback(push_force, right);
    assert_int_equal(knurl_loop_set_force(b.loop, up), KNURL_ERROR_STATE);
    assert_int_equal(knurl_loop_vibrate(b.loop, KNURL_WAVE_T3, 100.0, 1.0, up, 1.0), KNURL_ERROR_STATE);
    assert_int_equal(knurl_loop_set_gain(b.loop, 0.5), KNURL_OK);
    step(60);
    CHECK_VECTOR(written(0), 0.5, 0.0, 0.0, 1e-12);
}

/* Motor heat belongs to the device: it continues from loop to loop and cools by the clock in between; and a loop can
 * pause. By stepping and by the test's own clock. SPDX-License-Identifier: MIT */
#include "loop/bench.h"

/* 9 mm deep in a wall of 400 N/m: 3.6 N, of which the motors can play 3.3 N. */
#define DEPTH 0.009

static const double pressed[4] = {0.0, 0.0, -0.0095, 0.0};

static void add_squares(const knurl_tick_output *output, void *user) {
    *(double *)user += vec3_dot(output->device_force, output->device_force);
}

static double heat(void) {
    return bench_counts().heat;
}

static knurl_loop_stats stats(void) {
    return loop_stats(b.loop);
}

/* --- from loop to loop --- */

/* N: the rms force of 120 s of pressing, with a new loop every `seconds`. */
static double rms_of_loops(double seconds) {
    double sum = 0.0;
    knurl_device *device = NULL;
    bench_open(0.0);
    assert_int_equal(knurl_device_open("fake", &device), KNURL_OK);
    assert_int_equal(knurl_fake_set_trace(device, pressed, 1), KNURL_OK);
    b.desc.device = device;
    b.desc.tick_callback = add_squares;
    b.desc.user = &sum;
    for (int run = 0; run < (int)(120.0 / seconds); run++) {
        step((uint64_t)(1000.0 * seconds));
        bench_end_loop();
    }
    knurl_device_close(device);
    bench_close();
    return sqrt(sum / 120000.0);
}

/* The same two minutes, in one piece and in twenty: but for the ramps at their beginnings and ends they warm, and are
 * allowed, the same. */
TEST_WITH(two_minutes_of_pressing_are_two_minutes_in_however_many_loops, NULL, end_bench) {
    const double one = rms_of_loops(120.0);
    const double twenty = rms_of_loops(6.0);
    print_message("120 s of pressing: %.2f N rms in one loop, %.2f N rms in twenty\n", one, twenty);
    CHECK_CLOSE(twenty, one, 0.03 * one);
}

/* Three seconds of 3.3 N, then the HIP is 10 mm off the wall. Returns theta as the loop left it. */
static double warm_up(void) {
    bench_open(DEPTH);
    step(3000);
    bench_end_loop();
    b.position[1] = 0.01;
    return heat();
}

/* theta' = -theta/60 s. */
TEST_WITH(between_loops_motors_cool_by_the_loops_clock, NULL, end_bench) {
    static const double pauses[] = {0.0, 1.0, 60.0, 600.0};
    for (size_t i = 0; i < COUNT_OF(pauses); i++) {
        const double warm = warm_up();
        assert_true(warm > 0.6);
        b.now += (int64_t)(1e9 * pauses[i]);
        step(1);
        CHECK_CLOSE(heat(), warm * exp(-(pauses[i] + 0.001) / 60.0), 1e-9);
        CHECK_CLOSE(stats().heat, heat(), 1e-9);
        bench_close();
    }
}

/* Between a loop's creation and its start as well. */
TEST_WITH(a_loop_takes_over_the_heat_when_it_starts, NULL, end_bench) {
    const double warm = warm_up();
    bench_create();
    b.now += INT64_C(60000000000);
    step(1);
    CHECK_CLOSE(heat(), warm * exp(-60.001 / 60.0), 1e-9);
}

TEST_WITH(what_another_clock_says_cools_nothing, NULL, end_bench) {
    const double warm = warm_up();
    knurl_clock other = b.clock;
    static bench elsewhere;
    elsewhere.now = b.now + INT64_C(600000000000);
    other.user = &elsewhere;
    b.desc.clock = &other;
    step(1);
    CHECK_CLOSE(heat(), warm * exp(-0.001 / 60.0), 1e-9);
}

TEST_WITH(a_clock_that_was_set_back_cools_nothing, NULL, end_bench) {
    const double warm = warm_up();
    b.now -= INT64_C(900000000);
    step(1);
    CHECK_CLOSE(heat(), warm * exp(-0.001 / 60.0), 1e-9);
}

/* 100 ticks on a thread, the 50th of which comes `gap` seconds late. */
static void run_with_gap(double gap) {
    b.late = (int64_t)(1e9 * gap);
    b.late_for = 50;
    b.desc.tick_limit = 100;
    b.desc.ramp_s = 0.0;
    bench_create();
    assert_int_equal(knurl_loop_start(b.loop), KNURL_OK);
    assert_int_equal(knurl_loop_wait(b.loop, 10.0), 1);
}

/* A thread that does not run for a minute has rested for a minute. */
TEST_WITH(periods_that_a_thread_missed_cool_as_well, NULL, end_bench) {
    const double warm = warm_up();
    run_with_gap(60.0);
    CHECK_CLOSE(heat(), warm * exp(-60.1 / 60.0), 2e-5);
}

/* The force was not zeroed meanwhile: a caller's clock has no watchdog. */
TEST_WITH(periods_that_a_thread_missed_while_it_pressed_warm, NULL, end_bench) {
    bench_open(0.005); /* 2 N */
    run_with_gap(5.0);
    CHECK_CLOSE(heat(), 2.0 * 2.0 / (0.88 * 0.88) * (1.0 - exp(-5.1 / 60.0)), 0.005);
}

/* The motors differ from a HIP's configuration. */
TEST_WITH(what_a_hip_was_told_of_its_motors_is_no_matter_to_them, NULL, end_bench) {
    const struct {
        double continuous;
        uint32_t without;
    } hips[] = {{1.76, 0}, {(double)INFINITY, 0}, {KNURL_DEFAULT, KNURL_PROTECT_HEAT}};
    for (size_t i = 0; i < COUNT_OF(hips); i++) {
        knurl_hip_desc hip;
        knurl_workspace workspace;
        bench_open(DEPTH);
        knurl_workspace_set_identity(&workspace);
        knurl_hip_desc_init(&hip, sizeof hip);
        hip.workspace = &workspace;
        hip.continuous_force = hips[i].continuous;
        hip.protections = KNURL_PROTECT_ALL & ~hips[i].without;
        assert_int_equal(knurl_scene_configure_hip(b.scene, 0, &hip), KNURL_OK);
        step(2000);
        bench_end_loop();
        b.position[1] = 0.01;
        hip.continuous_force = KNURL_DEFAULT;
        hip.protections = KNURL_PROTECT_ALL;
        assert_int_equal(knurl_scene_configure_hip(b.scene, 0, &hip), KNURL_OK);
        step(1);
        /* 3.3 N within some ticks, and a ramp at the end: 2 s to 1 % */
        CHECK_CLOSE(heat(), 3.3 * 3.3 / (0.88 * 0.88) * (1.0 - exp(-2.0 / 60.0)), 0.005);
        bench_close();
    }
}

static void push(uint64_t tick, const knurl_device_sample *sample, double force[3], void *user) {
    (void)sample;
    *(uint64_t *)user = tick + 1;
    force[1] = 3.3;
}

TEST_WITH(a_callback_and_a_scene_warm_the_same_motors, NULL, end_bench) {
    uint64_t calls = 0;
    const double warm = warm_up();
    bench_create_callback(push, &calls);
    step(500);
    const double target = 3.3 * 3.3 / (0.88 * 0.88);
    CHECK_CLOSE(stats().heat, target + (warm - target) * exp(-0.5 / 60.0), 1e-9);
}

/* --- pause --- */

static void check_next_event(int32_t code) {
    knurl_device_event event = {0};
    assert_int_equal(knurl_device_next_event(&b.device, &event), code != 0);
    assert_int_equal(event.code, code);
}

/* 21 steps down, 21 up; walls come back with 0.5 mm a tick. */
TEST_WITH(a_pause_takes_the_force_away_by_the_ramp_and_a_resume_brings_it_back, NULL, end_bench) {
    bench_open(DEPTH);
    step(100);
    assert_int_equal(stats().paused, 0);
    knurl_loop_pause(b.loop);
    knurl_loop_pause(b.loop);
    assert_int_equal(stats().paused, 1);
    for (int k = 1; k <= 40; k++) {
        step(1);
        CHECK_CLOSE(written_now(), 3.3 * fmax(0.0, 1.0 - k / 21.0), 1e-12);
        CHECK_CLOSE(bench_tick().force[1], written_now(), 1e-12);
    }
    check_next_event(0);
    knurl_loop_resume(b.loop);
    knurl_loop_resume(b.loop);
    assert_int_equal(stats().paused, 0);
    for (int k = 0; k < 40; k++) {
        step(1);
        assert_true(written_now() <= fmin(3.3 * k / 21.0, 400.0 * 0.0005 * k) + 1e-12);
    }
    CHECK_CLOSE(written_now(), 3.3, 1e-12);
    check_next_event(KNURL_FAULT_RESUMED);
    check_next_event(0);
    assert_true(stats().ticks == 180);
}

TEST_WITH(paused_the_hip_moves_and_nothing_is_felt, NULL, end_bench) {
    bench_open(DEPTH);
    step(100);
    knurl_loop_pause(b.loop);
    step(30);
    const uint64_t touched = bench_counts().contact_ticks;
    for (int k = 0; k < 50; k++) {
        b.position[0] += 0.0001;
        step(1);
        const knurl_tick_output now = bench_tick();
        CHECK_VECTOR(now.hip, b.position[0], -DEPTH, 0.0, 1e-12);
        CHECK_VECTOR(now.proxy, b.position[0], -DEPTH, 0.0, 1e-12);
        assert_true(now.surface == 0 && now.contacts == 0);
        assert_memory_equal(&now, &b.seen, sizeof now);
    }
    CHECK_CLOSE(bench_tick().hip_velocity[0], 0.1, 0.005);
    assert_true(bench_counts().contact_ticks == touched);
}

/* A minute is one time constant; 120 s are no longer than the heartbeat allows. */
TEST_WITH(paused_the_motors_cool_and_nobody_asks_for_a_sign_of_life, NULL, end_bench) {
    bench_open(DEPTH);
    b.desc.heartbeat_s = 0.1;
    bench_create();
    for (int frame = 0; frame < 50; frame++) {
        step(50);
        knurl_loop_heartbeat(b.loop);
    }
    knurl_loop_pause(b.loop);
    step(30);
    const double warm = heat();
    step(60000);
    CHECK_CLOSE(heat(), warm * exp(-1.0), 1e-9);
    knurl_loop_resume(b.loop);
    step(40);
    CHECK_CLOSE(written_now(), 3.3, 1e-12);
    check_next_event(KNURL_FAULT_RESUMED);
    check_next_event(0);
    step(200);
    check_next_event(KNURL_FAULT_HEARTBEAT);
    CHECK_SAME(written_now(), 0.0L);
}

TEST_WITH(a_loop_can_begin_paused_and_end_paused, NULL, end_bench) {
    bench_open(DEPTH);
    bench_create();
    knurl_loop_pause(b.loop);
    for (int k = 0; k < 50; k++) {
        step(1);
        CHECK_SAME(written_now(), 0.0L);
    }
    knurl_loop_stop(b.loop);
    const uint64_t writes = b.writes;
    step(1);
    for (uint64_t k = writes; k < b.writes; k++) {
        CHECK_SAME(b.written[k][1], 0.0L);
    }
    assert_int_equal(stats().state, KNURL_LOOP_DONE);
    assert_true(heat() == 0.0);
}

TEST_WITH(a_resume_half_way_down_goes_on_from_there, NULL, end_bench) {
    bench_open(0.005); /* 2 N */
    step(100);
    knurl_loop_pause(b.loop);
    step(10);
    const double low = written_now();
    assert_true(low > 0.5 && low < 1.5);
    knurl_loop_resume(b.loop);
    for (int k = 0; k < 20; k++) {
        const double before = written_now();
        step(1);
        assert_true(written_now() >= before && written_now() - before <= 2.0 / 21.0 + 1e-12);
    }
    CHECK_CLOSE(written_now(), 2.0, 1e-12);
}

TEST_WITH(paused_a_callback_is_called_on_and_its_force_is_not_sent, NULL, end_bench) {
    uint64_t calls = 0;
    bench_open(DEPTH);
    bench_create_callback(push, &calls);
    step(50);
    knurl_loop_pause(b.loop);
    step(50);
    assert_true(calls == 100);
    CHECK_SAME(written_now(), 0.0L);
    knurl_loop_resume(b.loop);
    step(50);
    CHECK_CLOSE(written_now(), 3.3, 1e-12);
}

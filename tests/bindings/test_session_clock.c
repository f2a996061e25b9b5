/* Surfaces that an engine moves in steps and shows in frames. SPDX-License-Identifier: MIT */
#include "session_rig.h"

#include <math.h>

static const double upright[4] = {0.0, 0.0, 0.0, 1.0};

/* 100 mm/s over 1000 ridges/m: at 1 kHz a ridge lasts 10 ticks. */
#define SPEED      0.1
#define RIDGES     1000.0
#define GAP        10.0
#define WARM_UP_S  1.5 /* until the clocks' rhythm is known */
#define MEASURED_S 1.5

typedef struct rig {
    knurl_session *s;
    knurl_surface_id plate;
    knurl_session_way way;
    float heights[4000];
    uint64_t ticks;
} rig;

static rig r; /* reset by set_up() */

static int end(void **state) {
    (void)state;
    knurl_session_destroy(r.s);
    memset(&r, 0, sizeof r);
    return 0;
}

/* A finger 1 mm deep in a long plate with ridges. */
static void set_up(int32_t method, uint32_t clock) {
    surface_parts parts = surface_plane();
    (void)end(NULL);
    r.s = make_session();
    set_grating(&parts, method, RIDGES, 0.0, 1e-4);
    parts.plane.half_extents[0] = 1.0;
    r.plate = add_surface(knurl_session_get_scene(r.s), &parts);
    r.way.clock = clock;
    begin_with(r.s, "fake", "");
    press(r.s, 0.0, 0.0);
}

/* Advances to a time, s, and records the heights. */
static void go_to(double time) {
    float rows[2 * 256];
    const uint64_t due = (uint64_t)(time * 1000.0 + 1e-9);
    while (r.ticks < due) {
        const uint32_t count = (uint32_t)(due - r.ticks < 256 ? due - r.ticks : 256);
        step(r.s, count);
        assert_int_equal(knurl_session_get_history(r.s, count, rows), count);
        for (uint32_t i = 0; i < count; i++) {
            r.heights[r.ticks++] = rows[2 * i];
        }
    }
}

static void move_to(double time) {
    const double position[3] = {SPEED * time, 0.0, 0.0};
    assert_int_equal(knurl_session_move_surface(r.s, r.plate, &r.way, position, upright), KNURL_OK);
}

static void tell(uint32_t clock, double time) {
    assert_int_equal(knurl_session_tell_time(r.s, clock, time), KNURL_OK);
}

/* The shortest and the longest time between rises, in ticks, once the rhythm is known. */
static void measure_gaps(double *shortest, double *longest) {
    uint64_t last = 0;
    *shortest = HUGE_VAL;
    *longest = 0.0;
    for (uint64_t i = (uint64_t)(1000.0 * WARM_UP_S); i < r.ticks; i++) {
        if (r.heights[i - 1] < 0.0F && r.heights[i] > 0.0F) {
            if (last > 0) {
                *shortest = fmin(*shortest, (double)(i - last));
                *longest = fmax(*longest, (double)(i - last));
            }
            last = i;
        }
    }
}

static int check_gaps(const char *what, double fps, double rate) {
    double shortest;
    double longest;
    measure_gaps(&shortest, &longest);
    if (shortest >= GAP - 1.0 && longest <= GAP + 1.0) {
        return 0;
    }
    print_error("%s: %g frames and %g steps a second: gaps of %g to %g ticks\n", what, fps, rate, shortest, longest);
    return 1;
}

static const double frame_rates[] = {30, 45, 60, 72, 90, 120, 144, 165, 240};
static const double step_rates[] = {30, 50, 60, 75, 100, 120, 144, 240};

/* An even pseudo-random number, -1 to 1. */
static double noise(uint32_t *seed) {
    *seed = *seed * 1664525u + 1013904223u;
    return (double)(*seed >> 8) / (double)(1u << 23) - 1.0;
}

/* Physics at one rate, shown at another: a frame shows the steps that were due when it began. `unsteady`: share of a
 * frame by which frames come late or early. */
static int play_steps(int32_t method, double fps, double rate, double unsteady, int is_guess) {
    uint32_t seed = 1;
    double steps = 0.0;
    set_up(method, is_guess ? KNURL_SESSION_FRAMES : KNURL_SESSION_STEPS);
    r.way.is_guess = (uint32_t)is_guess;
    for (double frame = 1.0; frame < fps * (WARM_UP_S + MEASURED_S); frame += 1.0) {
        const double now = (frame + 0.5 * unsteady * noise(&seed)) / fps;
        const double done = floor(now * rate + 1e-9);
        go_to(now);
        tell(KNURL_SESSION_FRAMES, frame / fps);
        tell(KNURL_SESSION_STEPS, done / rate);
        if (done > steps) {
            move_to(done / rate);
        }
        steps = done;
    }
    return check_gaps(unsteady > 0.0 ? "unsteady" : "steady", fps, rate);
}

static int play_all_steps(double unsteady, int is_guess) {
    int failed = 0;
    for (size_t i = 0; i < COUNT_OF(frame_rates) * COUNT_OF(step_rates); i++) {
        failed += play_steps(KNURL_METHOD_S1, frame_rates[i / COUNT_OF(step_rates)],
                             step_rates[i % COUNT_OF(step_rates)], unsteady, is_guess);
    }
    return failed;
}

TEST_WITH(surfaces_moved_by_physics_are_felt_evenly_at_any_pair_of_rates, NULL, end) {
    assert_int_equal(play_all_steps(0.0, 0), 0);
}

TEST_WITH(surfaces_moved_by_physics_are_felt_evenly_if_frames_come_unevenly, NULL, end) {
    assert_int_equal(play_all_steps(0.4, 0), 0);
}

TEST_WITH(surfaces_moved_by_physics_are_felt_evenly_if_they_were_taken_for_surfaces_moved_by_frames, NULL, end) {
    assert_int_equal(play_all_steps(0.0, 1) + play_all_steps(0.4, 1), 0);
}

TEST_WITH(surfaces_moved_by_physics_are_felt_evenly_with_the_default_method, NULL, end) {
    int failed = 0;
    for (size_t i = 0; i < COUNT_OF(frame_rates); i++) {
        failed += play_steps(KNURL_METHOD_DEFAULT, frame_rates[i], 60.0, 0.0, 0);
    }
    assert_int_equal(failed, 0);
}

/* A script moves objects by each frame's length, and frames have uneven lengths. */
static int play_frames(double fps, double rate, int is_guess) {
    uint32_t seed = 1;
    set_up(KNURL_METHOD_S1, is_guess ? KNURL_SESSION_STEPS : KNURL_SESSION_FRAMES);
    r.way.is_guess = (uint32_t)is_guess;
    for (double frame = 1.0; frame < fps * (WARM_UP_S + MEASURED_S); frame += 1.0) {
        const double now = (frame + 0.2 * noise(&seed)) / fps;
        go_to(now);
        tell(KNURL_SESSION_FRAMES, now);
        tell(KNURL_SESSION_STEPS, floor(now * rate) / rate);
        move_to(now);
    }
    return check_gaps("frames", fps, rate);
}

TEST_WITH(surfaces_moved_by_frames_are_felt_evenly, NULL, end) {
    int failed = 0;
    for (size_t i = 0; i < COUNT_OF(frame_rates); i++) {
        failed += play_frames(frame_rates[i], 50.0, 0);
    }
    assert_int_equal(failed, 0);
}

TEST_WITH(surfaces_moved_by_frames_are_felt_evenly_if_they_were_taken_for_surfaces_moved_by_physics, NULL, end) {
    int failed = 0;
    for (size_t i = 0; i < COUNT_OF(frame_rates) * COUNT_OF(step_rates); i++) {
        failed += play_frames(frame_rates[i / COUNT_OF(step_rates)], step_rates[i % COUNT_OF(step_rates)], 1);
    }
    assert_int_equal(failed, 0);
}

/* A body that sleeps for two of three steps. */
TEST_WITH(surfaces_that_move_less_often_than_their_clock_are_felt_evenly, NULL, end) {
    set_up(KNURL_METHOD_S1, KNURL_SESSION_STEPS);
    for (int steps = 1; (double)steps / 60.0 < WARM_UP_S + MEASURED_S; steps++) {
        go_to((double)steps / 60.0);
        tell(KNURL_SESSION_STEPS, (double)steps / 60.0);
        if (steps % 3 == 0) {
            move_to((double)steps / 60.0);
        }
    }
    assert_int_equal(check_gaps("seldom", 60.0, 20.0), 0);
}

/* The start of the engine's clock does not matter, nor days of run time. */
TEST_WITH(a_clock_may_begin_anywhere, NULL, end) {
    set_up(KNURL_METHOD_S1, KNURL_SESSION_STEPS);
    for (int steps = 1; (double)steps / 60.0 < WARM_UP_S + MEASURED_S; steps++) {
        go_to((double)steps / 60.0);
        tell(KNURL_SESSION_STEPS, 1e6 + (double)steps / 60.0);
        move_to((double)steps / 60.0);
    }
    assert_int_equal(check_gaps("late", 60.0, 60.0), 0);
}

/* After a frame of a second, or a clock that was set back, moves are again late by no more than two frames. */
TEST_WITH(a_stall_does_not_last, NULL, end) {
    double time = 0.0;
    set_up(KNURL_METHOD_S1, KNURL_SESSION_STEPS);
    for (int steps = 1; steps < 120; steps++) {
        time += steps == 60 ? 1.0 : 1.0 / 60.0;
        go_to(time);
        tell(KNURL_SESSION_STEPS, steps < 90 ? (double)steps / 60.0 : (double)(steps - 90) / 60.0);
        move_to((double)steps / 60.0);
    }
    step(r.s, 40);
    const knurl_session_clock *c = &r.s->clocks[KNURL_SESSION_STEPS];
    const double late = c->time + c->lag - time;
    assert_true(late > 0.0 && late < 2.5 / 60.0);
}

/* Physics at 50 steps a second, shown at 60 frames; after 60 frames its clock begins again. */
TEST_WITH(a_right_guess_survives_a_clock_that_is_set_back, NULL, end) {
    double steps = 0.0;
    set_up(KNURL_METHOD_S1, KNURL_SESSION_STEPS);
    r.way.is_guess = 1;
    for (double frame = 1.0; frame < 120.0; frame += 1.0) {
        const double done = floor(frame * 50.0 / 60.0 + 1e-9);
        go_to(frame / 60.0);
        tell(KNURL_SESSION_FRAMES, frame / 60.0);
        tell(KNURL_SESSION_STEPS, (frame < 60.0 ? done : done - 50.0) / 50.0);
        if (done > steps) {
            move_to(done / 50.0);
            assert_int_equal(r.way.clock, KNURL_SESSION_STEPS);
        }
        steps = done;
    }
}

/* The five ways in which a Unity game moves things, with the clock that the package guesses for each. Physics runs 50
 * times a second. A body with interpolation is shown a step late, in each frame. */
static const struct way {
    const char *name;
    uint32_t guess;
    int is_in_steps;
    double late; /* s */
} ways[] = {
    {"object, moved in Update (tween, Animator, Timeline)", KNURL_SESSION_FRAMES, 0, 0.0},
    {"object, moved in FixedUpdate; ArticulationBody", KNURL_SESSION_FRAMES, 1, 0.0},
    {"body, moved in FixedUpdate", KNURL_SESSION_STEPS, 1, 0.0},
    {"body, moved in Update (grabbed in VR)", KNURL_SESSION_STEPS, 0, 0.0},
    {"body with interpolation", KNURL_SESSION_FRAMES, 0, 0.02},
};

/* Hz: 10 ridges at a time, so that whole ticks are within a hundredth. */
static void measure_frequencies(double *lowest, double *highest) {
    enum { RIDGES_AT_A_TIME = 10 };
    uint64_t rises[RIDGES_AT_A_TIME];
    uint64_t count = 0;
    *lowest = HUGE_VAL;
    *highest = 0.0;
    for (uint64_t i = (uint64_t)(1000.0 * WARM_UP_S); i < r.ticks; i++) {
        if (r.heights[i - 1] < 0.0F && r.heights[i] > 0.0F) {
            uint64_t *before = &rises[count % RIDGES_AT_A_TIME];
            if (count >= RIDGES_AT_A_TIME) {
                const double frequency = 1000.0 * RIDGES_AT_A_TIME / (double)(i - *before);
                *lowest = fmin(*lowest, frequency);
                *highest = fmax(*highest, frequency);
            }
            *before = i;
            count++;
        }
    }
}

static void play_way(const struct way *way, double fps, double *lowest, double *highest) {
    const double rate = 50.0;
    double steps = 0.0;
    set_up(KNURL_METHOD_S1, way->guess);
    r.way.is_guess = 1;
    for (double frame = 1.0; frame < fps * (WARM_UP_S + MEASURED_S); frame += 1.0) {
        const double now = frame / fps;
        const double done = floor(now * rate + 1e-9);
        go_to(now);
        tell(KNURL_SESSION_FRAMES, now);
        tell(KNURL_SESSION_STEPS, done / rate);
        if (!way->is_in_steps || done > steps) {
            move_to((way->is_in_steps ? done / rate : now) - way->late);
        }
        steps = done;
    }
    measure_frequencies(lowest, highest);
}

TEST_WITH(each_way_of_moving_in_unity_is_felt_at_its_frequency, NULL, end) {
    static const double rates[] = {30, 45, 60, 72, 90, 120, 144};
    int failed = 0;
    for (size_t w = 0; w < COUNT_OF(ways); w++) {
        print_message("%-52s", ways[w].name);
        for (size_t i = 0; i < COUNT_OF(rates); i++) {
            double lowest;
            double highest;
            play_way(&ways[w], rates[i], &lowest, &highest);
            print_message(" %g fps %.1f-%.1f", rates[i], lowest, highest);
            failed += !(98.9 <= lowest && lowest <= highest &&
                        highest <= 101.1); /* 100 Hz; lowest is infinite if nothing is felt */
        }
        print_message("\n");
    }
    assert_int_equal(failed, 0);
}

TEST_WITH(bad_clocks_are_refused, NULL, end) {
    const double position[3] = {0.0, 0.0, 0.0};
    set_up(KNURL_METHOD_S1, KNURL_SESSION_STEPS);
    assert_int_equal(knurl_session_tell_time(r.s, KNURL_SESSION_CLOCKS, 0.0), KNURL_ERROR_ARGUMENT);
    check_message("clock");
    assert_int_equal(knurl_session_tell_time(r.s, KNURL_SESSION_STEPS, NAN), KNURL_ERROR_ARGUMENT);
    check_message("finite");
    r.way.clock = KNURL_SESSION_CLOCKS;
    CHECK_REFUSED(knurl_session_move_surface(r.s, r.plate, &r.way, position, upright), KNURL_ERROR_ARGUMENT, r.way);
    check_message("clock");
}

/* A film that is written, of 60 frames to a second of the game, at 240 frames a second: the plate comes up by 0.5 mm in
 * 12 s of the game, and is there 0.2 s after the last frame. */
TEST_WITH(a_game_whose_clock_runs_fast_is_followed, NULL, end) {
    double position[3] = {0.0, 0.0, 0.0};
    set_up(KNURL_METHOD_S1, KNURL_SESSION_FRAMES);
    for (int frame = 1; frame <= 720; frame++) {
        step(r.s, 4);
        position[2] = 0.0005 * frame / 720.0;
        tell(KNURL_SESSION_FRAMES, frame / 60.0);
        assert_int_equal(knurl_session_move_surface(r.s, r.plate, &r.way, position, upright), KNURL_OK);
    }
    step(r.s, 200);
    CHECK_CLOSE(state_of(r.s).proxy[2], 0.0005, 1e-12);
}

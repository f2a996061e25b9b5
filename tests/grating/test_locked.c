/* The method LOCKED, a grating at a time, against knurl_grating_step()'s description and Eqs. 10 to 13.
 * SPDX-License-Identifier: MIT */
#include "support/locked.h"

#define RATE 1000.0
#define FS   1000.0 /* cycles/m */

/* Eq. 11 of bars across x. */
static double bars(double x) {
    static const double fs[2] = {FS, 0.0};
    const double position[2] = {x, 0.0};
    return knurl_grating_s1(position, fs, A);
}

/* 0.119 m/s is 119 Hz. Positions that lie on no edge. */
TEST(below_the_crossover_the_height_is_that_of_the_place_forwards_and_back) {
    locked_walk w = walk_on(KNURL_METHOD_LOCKED, FS, 0.0, RATE);
    uint64_t seed = 1;
    double x = 0.0123456;
    for (int k = 0; k < 20000; k++) {
        const double speed = random_between(&seed, -0.119, 0.119);
        x += speed / RATE;
        CHECK_SAME(walk_x(&w, x, speed), bars(x));
        assert_true(w.out.event == KNURL_NO_EVENT);
        CHECK_SAME(w.out.temporal_frequency, FS * fabs(speed));
    }
    assert_true(w.state.event_count == 0);
}

/* Ridges across y as well: the direction is that of the one frequency. */
TEST(bars_across_y_are_followed_along_y) {
    locked_walk w = walk_on(KNURL_METHOD_LOCKED, 0.0, FS, RATE);
    for (int k = 0; k < 500; k++) {
        const double position[2] = {0.3, 0.0001 * k + 1e-5};
        const double velocity[2] = {0.4, 0.1};
        CHECK_SAME(walk(&w, position, velocity), bars(position[1]));
    }
}

/* The first event begins where the surface rises, whatever the start, and within a cycle of it. */
TEST(above_the_crossover_events_begin_at_a_rising_edge) {
    for (int i = 0; i < 2 * 97; i++) {
        const double way = i % 2 ? 1.0 : -1.0;
        locked_walk w = walk_on(KNURL_METHOD_LOCKED, FS, 0.0, RATE);
        const double start = way * i / 97.0 / FS;
        for (int k = 0; w.out.event != 0; k++) {
            const double x = start + way * 0.00013 * k; /* 130 Hz: 7.7 ticks a cycle */
            const double height = walk_x(&w, x, way * 0.13);
            if (w.out.event == 0) {
                const double ahead = way * x * FS + 0.25;
                CHECK_CLOSE(ahead, floor(ahead + 0.5), 0.5 * 0.13 + 1e-9);
                CHECK_SAME(height, k > 0 || i == 0 ? w.state.event.positive : height);
            } else {
                CHECK_SAME(height, bars(x));
            }
            assert_true(k <= 9);
        }
    }
}

/* As the header has it: the whole number nearest T (1 - (p - n)), here at a speed that changes from event to event. */
TEST(an_event_ends_where_its_cycle_does_as_near_as_its_bounds_allow) {
    locked_walk w = walk_on(KNURL_METHOD_LOCKED, FS, 0.0, RATE);
    uint64_t seed = 2;
    double x = -0.25 / FS;
    double speed = 0.2;
    double played = 0.0;
    for (int k = 0; k < 20000; k++) {
        const int64_t before = w.state.event_count;
        (void)walk_x(&w, x, speed);
        if (w.state.event_count > before) {
            const double period = RATE / (FS * speed);
            const double wanted = period * (1.0 - (x * FS + 0.25 - played));
            const double least = fmin(floor(period), ceil(period / 1.38));
            const double most = fmax(ceil(period), floor(period * 1.38));
            CHECK_CLOSE(w.state.event.length, fmax(least, fmin(most, wanted)), 0.5 + 1e-6);
            played += 1.0;
        }
        if (!w.state.playing) {
            speed = random_between(&seed, 0.13, 0.45);
        }
        x += speed / RATE;
    }
    assert_true(w.state.event_count > 4000);
    CHECK_CLOSE(played, x * FS + 0.25, 1.5L);
}

/* Both frequencies: Eq. 12's cycles are a matter of the way. 60 Hz along a wandering direction, then 250 Hz. */
TEST(on_a_grid_cycles_are_those_of_the_way) {
    static const double grid[2] = {FS, 700.0};
    for (int fast = 0; fast < 2; fast++) {
        locked_walk w = walk_on(KNURL_METHOD_LOCKED, grid[0], grid[1], RATE);
        double position[2] = {0.1, 0.2};
        double way = 0.0;
        double cycles = 0.0;
        uint64_t seed = 3;
        for (int k = 0; k < 20000; k++) {
            const double angle = random_between(&seed, 0.0, 6.28);
            const double speed = (fast ? 250.0 : 60.0) / fmax(FS * fabs(cos(angle)), 700.0 * fabs(sin(angle)));
            const double velocity[2] = {speed * cos(angle), speed * sin(angle)};
            position[0] += velocity[0] / RATE;
            position[1] += velocity[1] / RATE;
            way += knurl_grating_frequency(grid, velocity) / RATE;
            const double last = w.last;
            const int64_t events = w.state.event_count;
            const double height = walk(&w, position, velocity);
            cycles += fast ? (double)(w.state.event_count - events) : last < 0.0 && height > 0.0 ? 1.0 : 0.0;
            if (fast) {
                CHECK_CLOSE(cycles, way, 1.26L); /* the event that plays counts from its begin */
            } else if (fabs(2.0 * way - floor(2.0 * way + 0.5)) > 1e-9) { /* on no edge */
                CHECK_SAME(height, way - floor(way) < 0.5 ? A : -A);
                CHECK_SAME(cycles, floor(way));
            }
        }
    }
}

/* No place to go by, and one direction of ridges: the way again. */
TEST(without_a_position_the_way_is_counted) {
    locked_walk w = walk_on(KNURL_METHOD_LOCKED, FS, 0.0, RATE);
    const double velocity[2] = {-0.0625, 0.3};
    for (int k = 1; k < 1000; k++) { /* a sixteenth of a cycle a tick */
        CHECK_SAME(walk(&w, NULL, velocity), k % 16 < 8 ? A : -A);
    }
}

/* Stops in every tick of an event of 7: it plays on, unchanged, and then the place decides, but for the last tenth of
 * the ridge that the event has played: events begin at 1, 2, ... cycles. */
TEST(after_a_stop_in_an_event_the_height_is_that_of_the_place) {
    for (int stop = 20; stop < 27; stop++) {
        locked_walk w = walk_on(KNURL_METHOD_LOCKED, FS, 0.0, RATE);
        double x = 0.00001;
        int rest = 0;
        for (int k = 0; k < 60; k++) {
            const int64_t events = w.state.event_count;
            x += k < stop ? 0.143e-3 : 0.0;
            const double height = walk_x(&w, x, k < stop ? 0.143 : 0.0);
            assert_true(k < stop || w.state.event_count == events);
            rest += w.out.event == KNURL_NO_EVENT && k >= stop;
            if (rest > 0) {
                const double ahead = (double)events + 1.0 - (x * FS + 0.25);
                CHECK_SAME(height, ahead > 0.5 && ahead < 0.6 ? -A : bars(x));
            }
        }
        assert_true(rest >= 60 - stop - 7);
    }
}

/* The hand slows down from 200 to 85 Hz as an event of 5 ticks begins, at 1.05 cycles: as it is over the position has
 * got to 1.475, the last of the ridge that it has played. That is not felt as another ridge, the next one, at 2, is. */
TEST(the_last_tenth_of_a_ridge_that_an_event_has_played_is_not_felt) {
    locked_walk w = walk_on(KNURL_METHOD_LOCKED, FS, 0.0, RATE);
    double x = 0.0;
    int left = 0;
    for (int k = 0; x * FS + 0.25 < 3.0; k++) {
        const double speed = w.state.event_count == 0 ? 0.2 : 0.085;
        x += speed / RATE;
        const double height = walk_x(&w, x, speed);
        const double phase = x * FS + 0.25;
        if (w.state.event_count == 1 && w.out.event == KNURL_NO_EVENT) {
            left += phase < 1.5;
            CHECK_SAME(height, phase < 2.0 ? -A : bars(x));
        }
    }
    assert_int_equal(left, 1);
}

/* An event plays while the material gets a coarser grating: phases are counted anew, and the place decides. */
TEST(events_of_a_grating_that_has_changed_hold_nothing_down) {
    locked_walk w = walk_on(KNURL_METHOD_LOCKED, FS, 0.0, RATE);
    double x = 0.0123456;
    for (int k = 0; k < 200; k++) {
        const double speed = k < 40 ? 0.2 : 0.02;
        x += speed / RATE;
        w.grating.spatial_frequency[0] = k < 41 ? FS : 0.5 * FS;
        const double height = walk_x(&w, x, speed);
        if (k > 50) {
            static const double fs[2] = {0.5 * FS, 0.0};
            const double position[2] = {x, 0.0};
            CHECK_SAME(height, knurl_grating_s1(position, fs, A));
        }
    }
}

TEST(s2_has_come_down_to_the_surface_within_one_event_of_a_stop) {
    for (int stop = 20; stop < 27; stop++) {
        knurl_grating_state s = {0};
        const knurl_grating grating = {KNURL_METHOD_S2, {0}, {FS, 0.0}, A, RATE, 0.0, 0.0};
        for (int k = 0; k < 60; k++) {
            const double position[2] = {0.143e-3 * k, 0.0};
            const double velocity[2] = {k < stop ? 0.143 : 0.0, 0.0};
            knurl_grating_output out;
            knurl_grating_step(&grating, &s, position, velocity, &out);
            CHECK_SAME(k >= stop + 7 ? out.height : 0.0, 0.0);
        }
    }
}

/* Back over the same ridges: once the event is over the heights are the place's until a cycle begins, and the events
 * that follow begin where the surface rises backwards. */
TEST(a_reversal_crosses_the_same_ridges_again) {
    for (int turn = 20; turn < 40; turn++) {
        locked_walk w = walk_on(KNURL_METHOD_LOCKED, FS, 0.0, RATE);
        double x = 0.00001;
        int64_t events = 0;
        int over = 0; /* the event that was turned in */
        int begun = 0;
        for (int k = 0; k < 90; k++) {
            const double speed = k < turn ? 0.2 : -0.2;
            x += speed / RATE;
            const double height = walk_x(&w, x, speed);
            events = k < turn ? w.state.event_count : events;
            over |= k >= turn && (w.out.event == KNURL_NO_EVENT || w.state.event_count > events);
            if (over && !begun && w.state.event_count > events) {
                const double ahead = -x * FS + 0.25;
                CHECK_CLOSE(ahead, floor(ahead + 0.5), 0.11L);
                begun = 1;
            }
            CHECK_SAME(over && !begun ? height : bars(x), bars(x));
        }
        assert_true(over && begun);
        CHECK_CLOSE((double)(w.state.event_count - events), 0.2 * (89 - turn), 2.0L);
    }
}

TEST(amplitude_and_length_are_held_until_the_event_ends) {
    locked_walk w = walk_on(KNURL_METHOD_LOCKED, FS, 0.0, RATE);
    uint64_t seed = 4;
    double x = 0.0;
    double amplitude = A;
    for (int k = 0; k < 20000; k++) {
        const int was_playing = w.state.playing;
        const knurl_vibration_event event = w.state.event;
        w.grating.amplitude = random_between(&seed, 0.1 * A, A);
        w.grating.spatial_frequency[0] = random_between(&seed, 0.6 * FS, 1.4 * FS);
        x += 0.25e-3;
        (void)walk_x(&w, x, 0.25); /* checks each event's sum */
        amplitude = was_playing ? amplitude : w.grating.amplitude;
        assert_true(w.out.event != KNURL_NO_EVENT || k < 10);
        if (was_playing) {
            CHECK_SAME(w.state.event.positive, event.positive);
            CHECK_SAME(w.state.event.negative, event.negative);
            assert_int_equal(w.state.event.length, event.length);
            assert_int_equal(w.state.event.positive_ticks, event.positive_ticks);
        }
        if (w.out.event != KNURL_NO_EVENT) { /* Eq. 7: Ap An = A^2 */
            CHECK_CLOSE(sqrt(w.state.event.positive * w.state.event.negative), amplitude, 1e-15L);
        }
    }
}

/* A hand that starts, stops, turns and jumps as it likes; walk() looks at every tick. */
TEST(no_motion_makes_a_step_above_that_of_a_trough_to_a_crest) {
    uint64_t seed = 5;
    for (int run = 0; run < 20; run++) {
        locked_walk w = walk_on(KNURL_METHOD_LOCKED, run % 3 ? FS : 0.0, run % 3 == 1 ? 0.0 : 800.0, RATE);
        double position[2] = {0.0, 0.0};
        double velocity[2] = {0.0, 0.0};
        w.grating.resolution = run % 2 ? 5e-5 : 0.0;
        for (int k = 0; k < 10000; k++) {
            const double change = random_bits(&seed) % 8 == 0 ? 0.4 : 0.02;
            for (int i = 0; i < 2; i++) {
                velocity[i] += random_between(&seed, -change, change) - 0.01 * velocity[i];
                position[i] += velocity[i] / RATE + (random_bits(&seed) % 1000 == 0 ? 0.01 : 0.0);
            }
            (void)walk(&w, position, velocity);
        }
        assert_true(w.state.event_count > 100);
    }
}

/* S2's is higher because of its 400 Hz mix: crest (2 + 3 sqrt(1/2))/sqrt(13), trough (2 + 3 sqrt(2))/sqrt(13). */
TEST(s2_steps_up_to_2_87_amplitudes) {
    const knurl_grating grating = {KNURL_METHOD_S2, {0}, {FS, 0.0}, A, RATE, 0.0, 0.0};
    const double origin[2] = {0.0, 0.0};
    knurl_grating_state s = {0};
    uint64_t seed = 6;
    double last = 0.0;
    double highest = 0.0;
    for (int k = 0; k < 50000; k++) {
        const double velocity[2] = {random_between(&seed, -0.5, 0.5), 0.0};
        knurl_grating_output out;
        knurl_grating_step(&grating, &s, origin, velocity, &out);
        highest = fmax(highest, fabs(out.height - last));
        last = out.height;
    }
    CHECK_CLOSE(highest, A * (4.0 + 3.0 * (sqrt(0.5) + sqrt(2.0))) / sqrt(13.0), 1e-12L * A);
    assert_true(highest < 2.875 * A && highest > HIGHEST_STEP);
}

/* An encoder at rest on an edge: one count to and fro, at any of the places of a count round the edge. */
TEST(at_rest_on_an_edge_a_flickering_count_does_not_toggle_the_height) {
    const double count = 0.055e-3;
    for (int place = -20; place <= 20; place++) {
        locked_walk w = walk_on(KNURL_METHOD_LOCKED, FS, 0.0, RATE);
        uint64_t seed = 7;
        double first = 0.0;
        w.grating.resolution = count;
        for (int k = 0; k < 200; k++) {
            const double flicker = random_bits(&seed) % 2 ? count : 0.0;
            const double x = 0.25 / FS + count * place / 20.0 - 0.5 * count + flicker;
            const double height = walk_x(&w, x, k < 20 ? 0.0 : flicker > 0.0 ? 0.0037 : -0.0037);
            first = k == 20 ? height : first;
            CHECK_SAME(k > 20 ? height : first, first);
        }
    }
}

/* 1 mm/s over 20 ridges, there and back: 18 ticks a count. */
TEST(slowly_across_edges_each_of_them_toggles_once) {
    const double count = 0.055e-3;
    locked_walk w = walk_on(KNURL_METHOD_LOCKED, FS, 0.0, RATE);
    int toggles = 0;
    w.grating.resolution = count;
    for (int k = 0; k < 40000; k++) {
        const double true_x = 1e-6 * (k < 20000 ? k : 40000 - k);
        const double noise = k % 3 == 0 ? 0.4 * count : 0.0; /* it flickers where it is between two counts */
        const double x = count * floor((true_x + noise) / count + 0.5);
        const double last = w.last;
        const double height = walk_x(&w, x, k < 20000 ? 0.001 : -0.001);
        toggles += k > 0 && height * last < 0.0;
    }
    assert_int_equal(toggles, 80);
}

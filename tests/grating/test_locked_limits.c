/* The method LOCKED where nobody should take it: no numbers, jumps, more ridges than ticks, the slowest and the fastest
 * loops. SPDX-License-Identifier: MIT */
#include "support/locked.h"

#define RATE 1000.0
#define FS   1000.0 /* cycles/m */

static double bars(double x) {
    static const double fs[2] = {FS, 0.0};
    const double position[2] = {x, 0.0};
    return knurl_grating_s1(position, fs, A);
}

/* As if nothing had been: within two cycles what is felt is where the HIP is. */
static void check_recovery(locked_walk *w) {
    double x = 0.0123456;
    for (int k = 0; k < 200; k++) {
        x += 0.05e-3;
        const double height = walk_x(w, x, 0.05);
        CHECK_SAME(k > 20 ? height : bars(x), bars(x));
    }
    int64_t events = w->state.event_count;
    for (int k = 0; k < 200; k++) {
        x += 0.25e-3;
        (void)walk_x(w, x, 0.25);
        if (w->state.event_count > events) {
            events = w->state.event_count;
            CHECK_CLOSE(x * FS + 0.25, floor(x * FS + 0.75), 0.126L);
        }
    }
    assert_true(events > 40);
}

static const double strange[] = {(double)NAN, (double)INFINITY, -(double)INFINITY, 1e300, -1e300, 1e18, -1e18, 0.0};

TEST(velocities_that_are_no_numbers_pass) {
    for (size_t i = 0; i < COUNT_OF(strange) * COUNT_OF(strange) * 2; i++) {
        locked_walk w = walk_on(KNURL_METHOD_LOCKED, FS, i % 2 ? 0.0 : 1e-300, RATE);
        const double velocity[2] = {strange[i / 2 % COUNT_OF(strange)], strange[i / 2 / COUNT_OF(strange)]};
        const double start[2] = {0.0, 0.0};
        for (int k = 0; k < 50; k++) {
            (void)walk(&w, k % 3 ? start : NULL, velocity);
        }
        w.grating.spatial_frequency[1] = 0.0;
        check_recovery(&w);
    }
}

/* A count of cycles that was once no number would stay so. */
TEST(on_a_grid_what_is_no_number_is_not_counted) {
    for (size_t i = 0; i < COUNT_OF(strange); i++) {
        locked_walk w = walk_on(KNURL_METHOD_LOCKED, FS, 800.0, RATE);
        const double bad[2] = {strange[i], 0.01};
        const double good[2] = {0.0625, 0.01};
        for (int k = 0; k < 20; k++) {
            (void)walk(&w, NULL, bad);
        }
        int highs = 0;
        for (int k = 0; k < 1600; k++) {
            highs += walk(&w, NULL, good) > 0.0;
        }
        assert_true(w.state.event_count <= 20);
        CHECK_CLOSE(highs, 800, 16); /* sixteen ticks a cycle, half of them high */
    }
}

TEST(positions_that_are_no_numbers_pass) {
    for (size_t i = 0; i < COUNT_OF(strange); i++) {
        for (int way = -1; way <= 1; way += 2) {
            locked_walk w = walk_on(KNURL_METHOD_LOCKED, FS, 0.0, RATE);
            for (int k = 0; k < 50; k++) {
                (void)walk_x(&w, k % 4 == 3 ? strange[i] : 1e-4 * k * way, 0.1 * (1 + k % 3) * way);
            }
            check_recovery(&w);
        }
    }
}

/* A jump is no way: it is neither made up for nor felt for longer than the event that plays. Forwards, back, far. */
TEST(a_seam_or_a_teleport_leaves_nothing_behind) {
    static const double jumps[] = {0.1, -0.1, 0.00037, -0.00037, 1234.5, -1234.5};
    for (size_t i = 0; i < 2 * COUNT_OF(jumps); i++) {
        const double speed = i % 2 ? 0.25 : 0.05;
        locked_walk w = walk_on(KNURL_METHOD_LOCKED, FS, 0.0, RATE);
        w.grating.resolution = 0.055e-3;
        double x = 0.0123456;
        for (int k = 0; k < 400; k++) {
            x += speed / RATE + (k == 200 ? jumps[i / 2] : 0.0);
            const int64_t events = w.state.event_count;
            const double height = walk_x(&w, x, speed);
            const int settled = k > 40 && (k < 200 || k > 210);
            if (settled && i % 2 == 0) {
                CHECK_SAME(height, bars(x));
            } else if (settled && w.state.event_count > events) {
                CHECK_CLOSE(x * FS + 0.25, floor(x * FS + 0.75), 0.126L);
            }
        }
        assert_true(i % 2 == 0 || w.state.event_count > 90);
    }
}

/* 2-tick events while f_t is above f_h/2, with up to 14 cycles crossed for each; afterwards no debt of them: within 16
 * ticks (events of 3 or 5 ticks, to gain up to half a cycle) it is in step at 4 ticks an event. */
TEST(saturation_leaves_no_debt) {
    static const double fast[] = {0.501, 0.7, 0.9, 1.0, 1.5, 7.25};
    for (size_t i = 0; i < COUNT_OF(fast); i++) {
        locked_walk w = walk_on(KNURL_METHOD_LOCKED, FS, 0.0, RATE);
        double x = 0.0001;
        int64_t events = 0;
        for (int k = 0; k < 1500; k++) {
            const double speed = k < 1000 ? fast[i] * RATE / FS : 0.25;
            x += speed / RATE;
            (void)walk_x(&w, x, speed);
            assert_int_equal(w.out.saturated, k < 1000);
            assert_true(k < 20 || k >= 1000 || w.state.event.length == 2);
            if (k >= 1016 && w.state.event_count > events) { /* in step again */
                CHECK_CLOSE(x * FS + 0.25, floor(x * FS + 0.75), 0.126L);
                assert_int_equal(w.state.event.length, 4);
            }
            events = w.state.event_count;
        }
    }
}

/* No event is longer than what its crossover allows, T (1 + JND) or the tick above T, and no loop hangs. */
TEST(any_grating_at_any_rate_plays_finite_events) {
    static const double rates[] = {1.0, 2.0, 7.0, 100.0, 1000.0, 10000.0, 99999.5, 100000.0};
    static const double frequencies[] = {1e-300, 1e-3, 1.0, 1e3, 1e6, 1e12, 1e300};
    static const double crossovers[] = {0.0, 1.0, 40.0, 1e6, 1e300};
    uint64_t seed = 8;
    for (size_t i = 0; i < COUNT_OF(rates) * COUNT_OF(frequencies) * COUNT_OF(crossovers); i++) {
        const double rate = rates[i % COUNT_OF(rates)];
        const double fs = frequencies[i / COUNT_OF(rates) % COUNT_OF(frequencies)];
        locked_walk w = walk_on(KNURL_METHOD_LOCKED, fs, 0.0, rate);
        w.grating.crossover_hz = crossovers[i / COUNT_OF(rates) / COUNT_OF(frequencies)];
        assert_int_equal(knurl_grating_check(&w.grating), KNURL_OK);
        const double lowest = w.grating.crossover_hz > 0.0 ? w.grating.crossover_hz : fmin(120.0, 0.25 * rate);
        double x = 0.0;
        for (int k = 0; k < 2000; k++) {
            const double speed = random_between(&seed, -1.0, 1.0);
            x += speed / rate;
            (void)walk_x(&w, x, speed);
            assert_true(w.state.event.length <= fmax(2.0, fmax(1.38 * rate / lowest, ceil(rate / lowest))));
        }
    }
}

/* Its state is what the other method left: nothing that was not played, nothing that does not end. */
TEST(a_change_of_method_plays_the_event_to_its_end) {
    uint64_t seed = 9;
    double x = 0.0;
    locked_walk w = walk_on(KNURL_METHOD_LOCKED, FS, 0.0, RATE);
    w.grating.resolution = 0.055e-3;
    for (int k = 0; k < 20000; k++) {
        const double speed = random_between(&seed, 0.13, 0.36); /* below the 400 Hz mix, which is S2's */
        const int was_playing = w.state.playing;
        if (random_bits(&seed) % 16 == 0) {
            w.grating.method = w.grating.method == KNURL_METHOD_S2 ? KNURL_METHOD_LOCKED : KNURL_METHOD_S2;
        }
        x += speed / RATE;
        (void)walk_x(&w, x, speed); /* checks each event's sum */
        assert_true(!was_playing || w.out.event != KNURL_NO_EVENT);
    }
    w.grating.method = KNURL_METHOD_LOCKED;
    check_recovery(&w);
}

/* The method AREA where nobody should take it, and where it hands over to LOCKED's events and back.
 * SPDX-License-Identifier: MIT */
#include "support/area.h"

#define RATE 1000.0
#define FS   1000.0 /* cycles/m */

static const double strange[] = {(double)NAN, (double)INFINITY, -(double)INFINITY, 1e300, -1e300, 1e18, -1e18, 0.0};

/* As if nothing had been: at once it is the mean of where the HIP went. */
static void check_recovery(area_walk *w) {
    double x = 0.0123456;
    area_walk fresh = area_on(FS, 0.0, RATE);
    w->grating = fresh.grating;
    for (int k = 0; k < 50; k++) {
        x += 0.137e-3;
        const double height = area_x(w, x, 0.137);
        const double expected = area_x(&fresh, x, 0.137);
        CHECK_CLOSE(height, k > 8 ? expected : height, 1e-9L * A); /* the jump to x, and an event that still plays */
    }
}

TEST(velocities_that_are_no_numbers_pass) {
    for (size_t i = 0; i < COUNT_OF(strange) * COUNT_OF(strange) * 4; i++) {
        area_walk w = area_on(FS, i % 2 ? 0.0 : 800.0, RATE);
        const double velocity[2] = {strange[i / 4 % COUNT_OF(strange)], strange[i / 4 / COUNT_OF(strange)]};
        const double start[2] = {0.0, 0.0};
        for (int k = 0; k < 50; k++) {
            (void)area(&w, k % 3 == 0 && i / 2 % 2 ? start : NULL, velocity);
        }
        check_recovery(&w);
    }
}

TEST(positions_that_are_no_numbers_pass) {
    for (size_t i = 0; i < COUNT_OF(strange) * COUNT_OF(strange) * 2; i++) {
        area_walk w = area_on(FS, i % 2 ? 0.0 : 800.0, RATE);
        const double bad[2] = {strange[i / 2 % COUNT_OF(strange)], strange[i / 2 / COUNT_OF(strange)]};
        for (int k = 0; k < 50; k++) {
            const double good[2] = {1e-4 * k, 2e-5 * k};
            const double velocity[2] = {0.1 * (1 + k % 3), 0.02};
            (void)area(&w, k % 4 == 3 ? bad : good, velocity);
        }
        check_recovery(&w);
    }
}

/* Counted by the velocity, on a line and a grid: once it is no number, and then half a cycle a tick of 16. */
TEST(what_is_no_number_is_not_counted) {
    for (size_t i = 0; i < 2 * COUNT_OF(strange); i++) {
        area_walk w = area_on(FS, i % 2 ? 800.0 : 0.0, RATE);
        const double bad[2] = {strange[i / 2], 0.01};
        const double good[2] = {0.0625, 0.01};
        for (int k = 0; k < 20; k++) {
            (void)area(&w, NULL, bad);
        }
        int highs = 0;
        for (int k = 0; k < 1600; k++) {
            highs += area(&w, NULL, good) > 0.0;
        }
        CHECK_CLOSE(highs, 800, 16);
    }
}

/* Thousands of cycles in a tick, whatever the velocity makes of it: one tick of height 0 that is told, and then the
 * mean of the way at the new place. */
TEST(a_teleport_is_one_tick_of_nothing) {
    static const double jumps[] = {1234.5, -1234.5, 3.00037, -3.00037};
    for (size_t i = 0; i < 4 * COUNT_OF(jumps); i++) {
        const double jump = jumps[i / 4];
        area_walk w = area_on(FS, i % 2 ? 500.0 : 0.0, RATE);
        double x = 0.0123456;
        for (int k = 0; k < 100; k++) {
            x += 0.1e-3 + (k == 50 ? jump : 0.0);
            const double height = area_x(&w, x, k == 50 && i & 2 ? 0.1 + jump * RATE : 0.1);
            assert_int_equal(w.out.saturated, k == 50);
            if (k == 50) {
                CHECK_SAME(height, 0.0);
            } else if (k > 0 && i % 2 == 0) {
                area_walk fresh = area_on(FS, 0.0, RATE);
                (void)area_x(&fresh, x - 0.1e-3, 0.1);
                CHECK_CLOSE(height, area_x(&fresh, x, 0.1), k == 51 ? 2.0L * A : 1e-6L * A); /* 51: back again */
            }
        }
    }
}

/* FOAW's velocity is thousands of cycles a tick for up to 15 ms after a jump. */
TEST(after_a_teleport_a_velocity_that_has_not_come_down_begins_no_event) {
    area_walk w = area_on(FS, 0.0, RATE);
    for (int k = 0; k < 100; k++) {
        const double x = 1e-4 * k + (k < 50 ? 0.0 : 0.7);
        (void)area_x(&w, x, k >= 50 && k < 65 ? 47.0 : 0.1);
        assert_true(w.state.event.length == 0);
    }
}

/* A cycle and a bit to 46 % of a cycle: bounded, and continuous where a whole cycle is one tick. */
TEST(no_way_is_higher_than_half_a_cycles) {
    for (int i = 0; i <= 4000; i++) {
        const double d = i / 2000.0;
        for (int p = 0; p < 16; p++) {
            area_walk w = area_on(FS, 0.0, RATE);
            (void)area_x(&w, p / 16.0 / FS, 0.01);
            const double height = area_x(&w, (p / 16.0 + d) / FS, 0.01); /* area() looks at its bound */
            CHECK_CLOSE(d >= 1.0 ? height : 0.0, 0.0, 0.0L);
            CHECK_CLOSE(d > 0.95 ? height : 0.0, 0.0, 0.1L * A);
        }
    }
}

TEST(any_grating_at_any_rate_gives_finite_heights) {
    static const double rates[] = {1.0, 2.0, 7.0, 100.0, 1000.0, 10000.0, 99999.5, 100000.0};
    static const double frequencies[] = {1e-300, 1e-3, 1.0, 1e3, 1e6, 1e12, 1e300};
    uint64_t seed = 8;
    for (size_t i = 0; i < COUNT_OF(rates) * COUNT_OF(frequencies) * 2; i++) {
        const double rate = rates[i % COUNT_OF(rates)];
        const double fs = frequencies[i / COUNT_OF(rates) % COUNT_OF(frequencies)];
        area_walk w = area_on(fs, i / COUNT_OF(rates) / COUNT_OF(frequencies) ? fs : 0.0, rate);
        double x = 0.0;
        for (int k = 0; k < 2000; k++) {
            const double speed = random_between(&seed, -1.0, 1.0);
            x += speed / rate;
            (void)area_x(&w, x, speed);
            assert_true(w.state.event.length <= 3); /* its events are at 0.44 f_h and above */
        }
    }
}

/* From 0.3 to 0.6 f_h and back: events from 0.46 until 0.44 (and the end of one), each of them whole, and as many
 * ridges as are crossed while f_h/2 is not. */
TEST(near_half_the_rate_events_take_over_in_phase_and_hand_back) {
    area_walk w = area_on(FS, 0.0, RATE);
    double x = 0.0;
    double sum = 0.0;
    double first = -1.0;
    double ahead = 0.0;
    for (int k = 0; k < 4000; k++) {
        const double t = k / 4000.0;
        const double speed = 0.3 + 0.18 * (1.0 - cos(6.283185307179586 * t)) / 2.0; /* to 0.48 f_h */
        const int64_t events = w.state.event_count;
        const int was_playing = w.state.playing;
        x += speed / RATE;
        (void)area_x(&w, x, speed);
        const int in_event = was_playing || (w.state.next_tick > 0);
        assert_true(in_event ? speed > 0.438 : speed < 0.461);
        sum = in_event ? sum + w.height : 0.0;
        if (in_event && !w.state.playing) {
            CHECK_CLOSE(sum, 0.0, 1e-12L * A);
        }
        /* a ridge begins within half a cycle of its rising edge, a tick's way late */
        if (w.state.event_count > events) {
            ahead = (x - speed / RATE) * FS + 0.25 - (double)w.state.event_count;
            first = first < 0.0 && k > 10 ? ahead : first;
            CHECK_CLOSE(k > 10 ? ahead : first, first, 0.75L);
        }
    }
    CHECK_CLOSE(ahead, first, 0.5L); /* none is lost over the way there and back */
}

/* A speed that flickers by what FOAW does about the threshold does not go to and fro. */
TEST(the_hand_over_has_a_hysteresis) {
    area_walk w = area_on(FS, 0.0, RATE);
    uint64_t seed = 11;
    double x = 0.0;
    int changes = 0;
    int before = 0;
    for (int k = 0; k < 10000; k++) {
        const double speed = 0.455 + random_between(&seed, -0.009, 0.009);
        x += 0.455 / RATE;
        (void)area_x(&w, x, speed);
        changes += w.state.moving != before;
        before = w.state.moving;
    }
    assert_int_equal(changes, 1);
}

TEST(a_change_of_method_plays_the_event_to_its_end) {
    static const int32_t methods[] = {KNURL_METHOD_S1, KNURL_METHOD_S2, KNURL_METHOD_LOCKED, KNURL_METHOD_AREA};
    uint64_t seed = 9;
    double x = 0.0;
    area_walk w = area_on(FS, 0.0, RATE);
    double sum = 0.0;
    for (int k = 0; k < 20000; k++) {
        const double speed = random_between(&seed, 0.13, 0.36); /* below the 400 Hz mix, which is S2's */
        const int was_playing = w.state.playing;
        const int32_t tick = w.state.next_tick;
        if (random_bits(&seed) % 16 == 0) {
            w.grating.method = methods[random_bits(&seed) % 4];
        }
        x += speed / RATE;
        (void)area_x(&w, x, speed);
        assert_true(!was_playing || w.state.next_tick == tick + 1);
        sum = was_playing ? sum + w.height : w.height;
        if (was_playing && !w.state.playing) {
            CHECK_CLOSE(sum, 0.0, 1e-12L * A);
        }
    }
    w.grating.method = KNURL_METHOD_AREA;
    check_recovery(&w);
}

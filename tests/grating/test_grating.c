/* Gratings S1 and S2, and the parts shared by all methods, against Eqs. 10 to 13, Algorithm 7 and the paper's last
 * table. SPDX-License-Identifier: MIT */
#include "support/close.h"
#include "support/paper.h"

#include <knurl/grating.h>

#include <stdio.h>

static const double origin[2] = {0.0, 0.0};

static knurl_grating make_grating(int32_t method, double fsx, double fsy, double amplitude, double rate) {
    knurl_grating grating;
    memset(&grating, 0, sizeof(grating));
    grating.spatial_frequency[0] = fsx;
    grating.spatial_frequency[1] = fsy;
    grating.amplitude = amplitude;
    grating.update_rate_hz = rate;
    grating.method = method;
    assert_int_equal(knurl_grating_check(&grating), KNURL_OK);
    return grating;
}

/* One tick at a velocity; the position does not matter for S2. */
static knurl_grating_output step(const knurl_grating *grating, knurl_grating_state *state, double vx, double vy) {
    const double velocity[2] = {vx, vy};
    knurl_grating_output out;
    memset(&out, 0xA5, sizeof(out));
    knurl_grating_step(grating, state, origin, velocity, &out);
    return out;
}

/* The speed along x that gives a period of `milliticks` thousandths of a tick. */
static double speed_for(const knurl_grating *grating, int64_t milliticks) {
    return grating->update_rate_hz * 1000.0 / ((double)milliticks * grating->spatial_frequency[0]);
}

static double s1(const double x[2], const double fs[2], double amplitude) {
    const knurl_grating grating = make_grating(KNURL_METHOD_S1, fs[0], fs[1], amplitude, 1000.0);
    knurl_grating_state state = {0};
    knurl_grating_output out;
    knurl_grating_step(&grating, &state, x, origin, &out);
    assert_true(out.event == KNURL_NO_EVENT);
    return out.height;
}

TEST(s1_follows_the_product_of_cosines) {
    const long double pi = acosl(-1.0L);
    uint64_t seed = 2;
    for (int i = 0; i < 20000; i++) {
        const double x[2] = {random_between(&seed, -0.1, 0.1), random_between(&seed, -0.1, 0.1)};
        const double fs[2] = {random_between(&seed, 10.0, 3000.0),
                              i % 8 == 0 ? 0.0 : random_between(&seed, 1.0, 900.0)};
        const long double product = cosl(2.0L * pi * fs[0] * x[0]) * cosl(2.0L * pi * fs[1] * x[1]);
        if (fabsl(product) > 1e-9L) {
            CHECK_SAME(s1(x, fs, 0.3), product >= 0.0L ? 0.3 : -0.3);
        }
    }
}

TEST(s1_on_an_axis_changes_sign_a_quarter_period_off_its_origin) {
    static const double both[2] = {512.0, 256.0};
    static const double bars[2] = {512.0, 0.0};
    for (int64_t i = -64; i <= 64; i++) { /* sixteenths of a period: every edge is met exactly */
        const double x[2] = {(double)i / 8192.0, 0.0};
        const double y[2] = {0.0, (double)i / 4096.0};
        const double aside[2] = {x[0], 0.7};
        const double expected = (i + 68) % 16 < 8 ? 1.0 : -1.0;
        CHECK_SAME(s1(x, both, 1.0), expected);
        CHECK_SAME(s1(y, both, 1.0), expected);
        CHECK_SAME(s1(aside, bars, 1.0), expected);
    }
}

TEST(frequency_is_eqs_12_and_13_without_trigonometry) {
    uint64_t seed = 4;
    for (int i = 0; i < 20000; i++) {
        const double fs[2] = {random_between(&seed, 1.0, 3000.0), random_between(&seed, 1.0, 3000.0)};
        const double v[2] = {random_between(&seed, -0.5, 0.5), random_between(&seed, -0.5, 0.5)};
        const long double theta = atan2l(fabsl((long double)v[1]), fabsl((long double)v[0]));
        const long double edge = atan2l((long double)fs[0], (long double)fs[1]);
        const long double along = theta <= edge ? fs[0] * cosl(theta) : fs[1] * sinl(theta);
        const long double expected = along * hypotl((long double)v[0], (long double)v[1]);
        CHECK_CLOSE(knurl_grating_frequency(fs, v), expected, 1e-14L * expected);
    }
}

TEST(frequency_along_the_ridges_is_exactly_zero) {
    static const double bars[2] = {1000.0, 0.0};
    static const double along[2] = {0.0, -0.25}; /* cos(pi/2) is 6e-17 and not 0 */
    static const double across[2] = {-0.25, 0.1};
    CHECK_SAME(knurl_grating_frequency(bars, along), 0.0);
    CHECK_SAME(knurl_grating_frequency(bars, across), 250.0);
}

TEST(output_reports_frequencies_in_the_direction_of_motion) {
    static const int32_t methods[] = {KNURL_METHOD_S1, KNURL_METHOD_S2};
    for (size_t i = 0; i < COUNT_OF(methods); i++) {
        const knurl_grating grating = make_grating(methods[i], 1000.0, 500.0, 1.0, 1000.0);
        knurl_grating_state s = {0};
        knurl_grating_output out = step(&grating, &s, 0.03, -0.04); /* cos = 0.6, sin = 0.8: max(30, 20) Hz */
        CHECK_CLOSE(out.temporal_frequency, 30.0, 1e-12L);
        CHECK_CLOSE(out.spatial_frequency, 600.0, 1e-9L);
        out = step(&grating, &s, 0.0, 0.0);
        CHECK_SAME(out.temporal_frequency, 0.0);
        CHECK_SAME(out.spatial_frequency, 0.0);
    }
}

TEST(s2_at_constant_speed_is_t3_events_end_to_end) {
    for (int64_t m = 2003; m <= 24000; m += 97) {
        const knurl_grating grating = make_grating(KNURL_METHOD_S2, 1000.0, 0.0, 0.0027, 1000.0);
        const int64_t length = paper_t3_length(m);
        knurl_grating_state s = {0};
        for (int64_t k = 0; k < 60; k++) {
            const knurl_grating_output out = step(&grating, &s, speed_for(&grating, m), 0.0);
            CHECK_CLOSE(out.height, paper_t3((uint64_t)(k % length), m, 0.0027L), 1e-16L);
            assert_true(out.event == k / length);
            assert_true(s.event_count == k / length + 1);
        }
    }
}

TEST(s2_thresholds_are_decided_on_ticks_at_every_rate) {
    static const double rates[] = {1000.0, 2000.0, 3000.0, 10000.0};
    static const double frequencies[] = {300.0, 1000.0, 1400.0, 2100.0};
    static const int64_t periods[] = {2250, 2750, 3500, 4500, 5500, 22500};
    for (size_t i = 0; i < COUNT_OF(rates) * COUNT_OF(frequencies) * COUNT_OF(periods); i++) {
        const int64_t m = periods[i % 6];
        const knurl_grating grating = make_grating(KNURL_METHOD_S2, frequencies[i / 6 % 4], 0.0, 1.0, rates[i / 24]);
        knurl_grating_state s = {0};
        (void)step(&grating, &s, speed_for(&grating, m), 0.0);
        assert_int_equal(s.event.length, paper_t3_length(m));
    }
}

TEST(s2_at_400_hz_plays_the_six_tick_mix_to_its_end) {
    const knurl_grating grating = make_grating(KNURL_METHOD_S2, 1600.0, 0.0, 1.0, 1000.0);
    knurl_grating_state s = {0};
    /* Algorithm 7 as printed is evaluated again with Ta = 6 and plays +++--- from the second tick on */
    for (int64_t k = 0; k < 6; k++) {
        const double later[] = {0.25, 0.25, 0.02, 0.0, 0.2, 0.3}; /* 400 Hz at the start; the rest must not matter */
        CHECK_CLOSE(step(&grating, &s, later[k], 0.0).height, paper_mixed((uint64_t)k, 1.0L), 1e-15L);
    }
    for (int64_t k = 0; k < 12; k++) {
        CHECK_CLOSE(step(&grating, &s, 0.25, 0.0).height, paper_mixed((uint64_t)k, 1.0L), 1e-15L);
    }
}

TEST(s2_holds_amplitude_and_period_until_the_event_ends) {
    knurl_grating grating = make_grating(KNURL_METHOD_S2, 1000.0, 0.0, 1.0, 1000.0);
    knurl_grating_state s = {0};
    for (uint64_t k = 0; k < 12; k++) { /* five ticks of amplitude 1, then seven of 3 */
        const long double expected = k < 5 ? paper_t3(k, 5000, 1.0L) : paper_t3(k - 5, 7000, 3.0L);
        CHECK_CLOSE(step(&grating, &s, k == 0 ? 0.2 : 1.0 / 7.0, 0.0).height, expected, 1e-15L);
        grating.amplitude = 3.0;
        grating.spatial_frequency[1] = 100.0;
    }
}

TEST(s2_starts_no_event_below_one_millimetre_a_second_or_along_ridges) {
    static const double slow[][2] = {{0.0, 0.0}, {0.000999, 0.0}, {-0.000999, 0.0}, {0.0007, 0.0007}, {0.0, 0.000999}};
    static const double moving[][2] = {{0.001, 0.0}, {-0.001, 0.0}, {0.0008, 0.0008}, {0.0, -0.001001}};
    const knurl_grating grating = make_grating(KNURL_METHOD_S2, 1000.0, 1000.0, 1.0, 1000.0);
    for (size_t i = 0; i < COUNT_OF(slow); i++) {
        knurl_grating_state s = {0};
        const knurl_grating_output out = step(&grating, &s, slow[i][0], slow[i][1]);
        CHECK_SAME(out.height, 0.0);
        assert_true(out.event == KNURL_NO_EVENT);
        assert_true(s.event_count == 0);
    }
    const knurl_grating bars = make_grating(KNURL_METHOD_S2, 1000.0, 0.0, 1.0, 1000.0);
    knurl_grating_state none = {0};
    assert_true(step(&bars, &none, 0.0, 0.25).event == KNURL_NO_EVENT);
    CHECK_SAME(step(&bars, &none, 0.0, 0.25).height, 0.0);
    for (size_t i = 0; i < COUNT_OF(moving); i++) {
        knurl_grating_state s = {0};
        const knurl_grating_output out = step(&grating, &s, moving[i][0], moving[i][1]);
        assert_true(out.height > 0.0);
        assert_true(out.event == 0);
    }
}

/* Ridges of 20 um: an event at 1 mm/s is 20 ticks. A speed that flickers by 10 % about the deadband starts and stops
 * events if positions are exact, as in Algorithm 7; if they are quantised it continues until below half of it.
 */
TEST(s2_does_not_chatter_about_its_deadband_where_positions_are_quantised) {
    static const double quanta[2] = {0.0, 0.055e-3};
    for (int i = 0; i < 2; i++) {
        knurl_grating grating = make_grating(KNURL_METHOD_S2, 50000.0, 0.0, 1.0, 1000.0);
        knurl_grating_state s = {0};
        int stops = 0;
        int64_t last = KNURL_NO_EVENT;
        grating.resolution = quanta[i];
        assert_true(step(&grating, &s, 0.0009, 0.0).event == KNURL_NO_EVENT); /* never started below it */
        for (int k = 0; k < 2000; k++) {
            const knurl_grating_output out = step(&grating, &s, k / 13 % 2 ? 0.0009 : 0.0011, 0.0);
            stops += last != KNURL_NO_EVENT && out.event == KNURL_NO_EVENT;
            last = out.event;
        }
        assert_true(i == 0 ? stops > 20 : stops == 0);
        for (int k = 0; k < 40; k++) { /* the event's end */
            last = step(&grating, &s, 0.00049, 0.0).event;
        }
        assert_true(last == KNURL_NO_EVENT);
        assert_true(step(&grating, &s, 0.0009, 0.0).event == KNURL_NO_EVENT); /* it must start again */
    }
}

TEST(s2_plays_a_started_event_to_its_end_after_the_stop) {
    const knurl_grating grating = make_grating(KNURL_METHOD_S2, 1000.0, 0.0, 1.0, 1000.0);
    knurl_grating_state s = {0};
    for (uint64_t k = 0; k < 12; k++) {
        const knurl_grating_output out = step(&grating, &s, k == 0 ? 1.0 / 7.0 : 0.0, 0.0);
        CHECK_CLOSE(out.height, k < 7 ? paper_t3(k, 7000, 1.0L) : 0.0L, k < 7 ? 1e-15L : 0.0L);
        assert_true(out.event == (k < 7 ? 0 : KNURL_NO_EVENT));
    }
    assert_true(step(&grating, &s, 0.25, 0.0).event == 1);
}

TEST(above_half_the_update_rate_is_flagged_and_played_at_two_ticks) {
    const knurl_grating s1 = make_grating(KNURL_METHOD_S1, 4000.0, 0.0, 1.0, 1000.0);
    const knurl_grating s2 = make_grating(KNURL_METHOD_S2, 4000.0, 0.0, 1.0, 1000.0);
    knurl_grating_state s = {0};
    for (uint64_t k = 0; k < 10; k++) {
        const knurl_grating_output out = step(&s2, &s, 0.25, 0.0);
        CHECK_SAME(out.height, paper_square(k, 2, 1));
        CHECK_SAME(out.temporal_frequency, 1000.0); /* unclamped */
        assert_int_equal(out.above_nyquist, 1);
    }
    assert_int_equal(step(&s1, &s, 0.25, 0.0).above_nyquist, 1);
    assert_int_equal(step(&s1, &s, 0.125, 0.0).above_nyquist, 0); /* exactly half */
    assert_int_equal(step(&s2, &s, 0.125, 0.0).above_nyquist, 0);
}

TEST(every_complete_event_has_no_impulse_and_rms_of_its_amplitude) {
    knurl_grating grating = make_grating(KNURL_METHOD_S2, 1000.0, 400.0, 1.0, 1000.0);
    knurl_grating_state s = {0};
    long double sum = 0.0L;
    long double squares = 0.0L;
    long double amplitude = 0.0L;
    int64_t ticks = 0;
    int64_t last = 0;
    uint64_t seed = 5;
    while (last < 20000) {
        const double v[2] = {random_between(&seed, -0.5, 0.5), random_between(&seed, -0.5, 0.5)};
        const knurl_grating_output out = step(&grating, &s, v[0], v[1]);
        if (out.event != last) {
            CHECK_CLOSE(sum, 0.0L, 1e-12L * (long double)ticks);
            CHECK_CLOSE(sqrtl(squares / (long double)ticks), amplitude, 1e-12L);
            assert_true(out.event == last + 1);
            sum = squares = 0.0L;
            ticks = 0;
            last = out.event;
        }
        amplitude = ticks == 0 ? grating.amplitude : amplitude;
        sum += out.height;
        squares += (long double)out.height * out.height;
        ticks++;
        grating.amplitude = random_between(&seed, 0.1, 2.0);
    }
}

TEST(the_slowest_scan_of_the_coarsest_grating_plays_a_finite_event) {
    static const double coarse[] = {1e-3, 1e-9, 1e-300};
    for (size_t i = 0; i < COUNT_OF(coarse); i++) {
        const knurl_grating grating = make_grating(KNURL_METHOD_S2, coarse[i], 0.0, 1.0, 100000.0);
        knurl_grating_state s = {0};
        for (int k = 0; k < 100; k++) {
            CHECK_CLOSE(step(&grating, &s, 0.001, 0.0).height, 0.5L, 0.5L); /* 0 or A: never NaN */
        }
    }
}

TEST(default_method_is_resolved_to_bandlimited) {
    assert_int_equal(make_grating(KNURL_METHOD_DEFAULT, 1000.0, 0.0, 1.0, 1000.0).method, KNURL_METHOD_BANDLIMITED);
    assert_int_equal(make_grating(KNURL_METHOD_BANDLIMITED, 1000.0, 0.0, 1.0, 1000.0).method, KNURL_METHOD_BANDLIMITED);
    assert_int_equal(make_grating(KNURL_METHOD_S1, 1000.0, 0.0, 1.0, 1000.0).method, KNURL_METHOD_S1);
    assert_int_equal(make_grating(KNURL_METHOD_S2, 0.0, 0.0, 0.0, 1.0).method, KNURL_METHOD_S2);
    assert_int_equal(make_grating(KNURL_METHOD_S2, 1.0, 0.0, 0.0, 100000.0).method, KNURL_METHOD_S2);
}

TEST(unknown_methods_are_refused_with_a_sentence) {
    static const int32_t unknown[] = {-1, 5, 1000};
    knurl_grating grating = make_grating(KNURL_METHOD_S2, 1000.0, 0.0, 1.0, 1000.0);
    for (size_t i = 0; i < COUNT_OF(unknown); i++) {
        grating.method = unknown[i];
        CHECK_REFUSED(knurl_grating_check(&grating), KNURL_ERROR_UNKNOWN, grating);
        assert_non_null(strchr(knurl_error_message(), ' '));
    }
}

TEST(bad_gratings_are_refused_and_left_as_they_were) {
    static const double bad[][5] = {/* fsx, fsy, amplitude, rate, resolution */
                                    {-1.0, 0.0, 1.0, 1000.0},
                                    {1.0, 0.0, 1.0, 1000.0, -1e-9},
                                    {1.0, 0.0, 1.0, 1000.0, (double)NAN},
                                    {1.0, 0.0, 1.0, 1000.0, (double)INFINITY},
                                    {0.0, -1.0, 1.0, 1000.0},
                                    {(double)NAN, 0.0, 1.0, 1000.0},
                                    {0.0, (double)INFINITY, 1.0, 1000.0},
                                    {1.0, 1.0, -1.0, 1000.0},
                                    {1.0, 1.0, (double)NAN, 1000.0},
                                    {1.0, 1.0, (double)INFINITY, 1000.0},
                                    {1.0, 1.0, 1.0, 0.0},
                                    {1.0, 1.0, 1.0, 1e9},
                                    {1.0, 1.0, 1.0, (double)NAN}};
    for (size_t i = 0; i < COUNT_OF(bad); i++) {
        knurl_grating grating = {KNURL_METHOD_DEFAULT, {0}, {bad[i][0], bad[i][1]}, bad[i][2], bad[i][3], bad[i][4]};
        CHECK_REFUSED(knurl_grating_check(&grating), KNURL_ERROR_ARGUMENT, grating);
    }
}

TEST(without_a_grating_or_a_velocity_the_frequency_is_0) {
    static const double some[2] = {100.0, 200.0};
    CHECK_SAME(knurl_grating_frequency(NULL, some), 0.0);
    CHECK_SAME(knurl_grating_frequency(some, NULL), 0.0);
}

TEST(names_of_methods_go_both_ways) {
    static const char *const names[] = {"S1", "S2", "bandlimited"};
    static const int32_t methods[] = {KNURL_METHOD_S1, KNURL_METHOD_S2, KNURL_METHOD_BANDLIMITED};
    int32_t method = 77;
    for (size_t i = 0; i < COUNT_OF(names); i++) {
        assert_string_equal(knurl_method_name(methods[i]), names[i]);
        assert_int_equal(knurl_method_from_name(names[i], &method), KNURL_OK);
        assert_int_equal(method, methods[i]);
    }
    assert_null(knurl_method_name(KNURL_METHOD_DEFAULT));
    assert_null(knurl_method_name(-1));
    assert_null(knurl_method_name(1000));
}

TEST(unknown_names_are_refused_with_the_known_ones) {
    static const char *const names[] = {"", "s2", "S3", "S22", "S", "band", "Bandlimited"};
    int32_t method = 77;
    for (size_t i = 0; i < COUNT_OF(names); i++) {
        CHECK_REFUSED(knurl_method_from_name(names[i], &method), KNURL_ERROR_UNKNOWN, method);
        char found[32];
        (void)snprintf(found, sizeof found, ", found '%s'", names[i]);
        check_message("method: expected S1, S2");
        check_message(found);
    }
}

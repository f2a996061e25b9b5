/* Temporal methods T1, T2 and T3 against the paper's equations and algorithms.
 * SPDX-License-Identifier: MIT */
#include "support/close.h"
#include "support/paper.h"

#include <knurl/vibration.h>

static const double rates[] = {1000.0, 2000.0, 3000.0, 10000.0};

static knurl_wave make_wave(int32_t method, double ticks, double amplitude, double rate) {
    knurl_wave wave;
    assert_int_equal(knurl_wave_prepare(method, ticks / rate, amplitude, rate, &wave), KNURL_OK);
    return wave;
}

static knurl_vibration_event make_event(double ticks, double amplitude) {
    knurl_vibration_event event;
    assert_int_equal(knurl_vibration_event_prepare(ticks, amplitude, &event), KNURL_OK);
    return event;
}

/* The T3 event of a period that is given in seconds. */
static knurl_vibration_event event_of(double period_s, double rate) {
    knurl_wave wave;
    assert_int_equal(knurl_wave_prepare(KNURL_WAVE_T3, period_s, 1.0, rate, &wave), KNURL_OK);
    assert_int_equal(wave.part_count, 1);
    return wave.parts[0];
}

static long double sum_of(const knurl_wave *wave, int64_t ticks) {
    long double sum = 0.0L;
    for (uint64_t k = 0; k < (uint64_t)ticks; k++) {
        sum += knurl_wave_value(wave, k);
    }
    return sum;
}

static long double rms_of(const knurl_wave *wave, int64_t ticks) {
    long double sum = 0.0L;
    for (uint64_t k = 0; k < (uint64_t)ticks; k++) {
        sum += (long double)knurl_wave_value(wave, k) * knurl_wave_value(wave, k);
    }
    return sqrtl(sum / (long double)ticks);
}

TEST(even_multiples_are_one_square_wave_in_all_methods) {
    for (uint64_t n = 2; n <= 40; n += 2) {
        for (int32_t method = KNURL_WAVE_T1; method <= KNURL_WAVE_T3; method++) {
            const knurl_wave wave = make_wave(method, (double)n, 1.05, 1000.0);
            for (uint64_t k = 0; k < 3 * n; k++) {
                CHECK_SAME(knurl_wave_value(&wave, k), k % n < n / 2 ? 1.05 : -1.05);
            }
        }
    }
}

TEST(t1_nets_an_nth_of_its_amplitude_at_odd_multiples) {
    for (int64_t n = 3; n <= 41; n += 2) {
        const knurl_wave wave = make_wave(KNURL_WAVE_T1, (double)n, 2.1, 1000.0);
        CHECK_CLOSE(sum_of(&wave, n) / (long double)n, 2.1L / (long double)n, 1e-12L);
    }
    const knurl_wave wave = make_wave(KNURL_WAVE_T1, 2.5, 2.1, 1000.0);
    CHECK_CLOSE(sum_of(&wave, 5) / 5.0L, 2.1L / 5.0L, 1e-12L);
}

TEST(t2_and_t3_net_nothing_over_whole_actual_periods) {
    for (int64_t m = 2000; m <= 41000; m += 250) {
        const knurl_wave t2 = make_wave(KNURL_WAVE_T2, (double)m / 1000.0, 2.1, 1000.0);
        const knurl_wave t3 = make_wave(KNURL_WAVE_T3, (double)m / 1000.0, 2.1, 1000.0);
        CHECK_CLOSE(sum_of(&t2, paper_t2_length(m)), 0.0L, 2.1e-12L * (long double)m / 1000.0L);
        CHECK_CLOSE(sum_of(&t3, paper_t3_length(m)), 0.0L, 2.1e-12L * (long double)m / 1000.0L);
    }
}

TEST(rms_is_the_amplitude_at_integer_periods_and_at_2_5_ticks) {
    for (int64_t m = 2000; m <= 41000; m += m == 2000 || m == 2500 ? 500 : 1000) {
        const double n = (double)m / 1000.0;
        const knurl_wave t1 = make_wave(KNURL_WAVE_T1, n, 0.35, 1000.0);
        const knurl_wave t2 = make_wave(KNURL_WAVE_T2, n, 0.35, 1000.0);
        const knurl_wave t3 = make_wave(KNURL_WAVE_T3, n, 0.35, 1000.0);
        CHECK_CLOSE(rms_of(&t1, m / 500), 0.35, 1e-14L);
        CHECK_CLOSE(rms_of(&t2, paper_t2_length(m)), 0.35, 1e-14L);
        CHECK_CLOSE(rms_of(&t3, paper_t3_length(m)), 0.35, 1e-14L);
    }
}

/* Eq. 8 with Algorithm 4 at three ticks, by hand: (2 e + 3 o) / sqrt(13), e = 1 -1 1 -1 1 -1, o = r r -2r r r -2r,
 * r = 1/sqrt(2): 1.1430, 0.0337, -0.6220, 0.0337, 1.1430, -1.7314. */
TEST(t3_at_2_5_ticks_is_the_six_tick_mix_of_eq_8) {
    const long double s = sqrtl(13.0L);
    const long double r = sqrtl(0.5L);
    const long double expected[] = {(2 + 3 * r) / s,  (-2 + 3 * r) / s, (2 - 6 * r) / s,
                                    (-2 + 3 * r) / s, (2 + 3 * r) / s,  (-2 - 6 * r) / s};
    const knurl_wave wave = make_wave(KNURL_WAVE_T3, 2.5, 0.7, 1000.0);
    const knurl_vibration_event event = make_event(2.5, 0.7);
    assert_int_equal(event.length, 6);
    for (uint64_t k = 0; k < 24; k++) {
        CHECK_CLOSE(knurl_wave_value(&wave, k), 0.7 * expected[k % 6], 1e-15L);
        CHECK_CLOSE(knurl_vibration_event_height(&event, (int32_t)(k % 6)), 0.7 * expected[k % 6], 1e-15L);
    }
}

TEST(t3_thresholds_hold_for_periods_in_seconds) {
    static const double low[] = {0.00225, 0.001125, 0.00075, 0.000225};
    static const double high[] = {0.00275, 0.001375, 2.75 / 3000.0, 0.000275};
    for (size_t i = 0; i < COUNT_OF(rates); i++) {
        assert_int_equal(event_of(low[i] * (1.0 - 1e-6), rates[i]).kind, KNURL_EVENT_EVEN);
        assert_int_equal(event_of(low[i], rates[i]).kind, KNURL_EVENT_MIXED);
        assert_int_equal(event_of(2.25 * (1.0 / rates[i]), rates[i]).kind, KNURL_EVENT_MIXED);
        assert_int_equal(event_of(high[i], rates[i]).kind, KNURL_EVENT_MIXED);
        assert_int_equal(event_of(2.75 * (1.0 / rates[i]), rates[i]).kind, KNURL_EVENT_MIXED);
        assert_int_equal(event_of(high[i] * (1.0 + 1e-6), rates[i]).kind, KNURL_EVENT_ODD);
    }
}

TEST(t3_rounds_half_a_tick_up) {
    assert_int_equal(make_event(4.499999, 1.0).length, 4);
    assert_int_equal(make_event(4.5, 1.0).length, 5);
    for (int32_t n = 3; n <= 40; n++) {
        assert_int_equal(make_event((double)n + 0.5, 1.0).length, n + 1);
        for (size_t i = 0; i < COUNT_OF(rates); i++) {
            assert_int_equal(event_of(((double)n + 0.5) / rates[i], rates[i]).length, n + 1);
            assert_int_equal(event_of(((double)n + 0.5) * (1.0 / rates[i]), rates[i]).length, n + 1);
            assert_int_equal(event_of((double)n / rates[i], rates[i]).length, n);
        }
    }
}

TEST(t1_at_integer_periods_is_exact_at_any_tick_and_rate) {
    static const uint64_t starts[] = {0, 1000000007, UINT64_C(1) << 53, UINT64_MAX - 200};
    for (uint64_t n = 2; n <= 40; n++) { /* at 3 kHz a real modulo fails at 5, 7, 10, ... */
        for (size_t i = 0; i < COUNT_OF(rates) * COUNT_OF(starts); i++) {
            const knurl_wave wave = make_wave(KNURL_WAVE_T1, (double)n, 1.0, rates[i % 4]);
            for (uint64_t k = starts[i / 4]; k < starts[i / 4] + 120; k++) {
                CHECK_SAME(knurl_wave_value(&wave, k), paper_square(k, n, 1));
            }
        }
    }
}

TEST(t1_at_whole_frequencies_is_exact_at_every_rate) {
    for (uint64_t i = 20 * 4; i <= 500 * 4; i++) { /* 30 Hz goes wrong at ticks 250, 450, 500, ... in plain doubles */
        const double rate = rates[i % 4];
        knurl_wave wave;
        assert_int_equal(knurl_wave_prepare(KNURL_WAVE_T1, 1.0 / (double)(i / 4), 1.0, rate, &wave), KNURL_OK);
        for (uint64_t k = 0; k < 2000; k++) {
            CHECK_SAME(knurl_wave_value(&wave, k), paper_square(k, (uint64_t)rate, i / 4));
        }
    }
}

/* A period in doubles is known to 2^-53 or so: ticks exactly on an edge are not tested there. */
TEST(t1_at_rational_periods_keeps_its_phase_at_large_ticks) {
    static const uint64_t starts[] = {1000000, 1000000000, UINT64_C(1000000000000)};
    for (size_t i = 0; i < COUNT_OF(rates) * COUNT_OF(starts); i++) {
        const knurl_wave wave = make_wave(KNURL_WAVE_T1, 231.0 / 43.0, 1.0, rates[i % 4]);
        for (uint64_t k = starts[i / 4]; k < starts[i / 4] + 1000; k++) {
            const uint64_t phase = k % 231 * 43 % 231;
            if (phase != 0) {
                CHECK_SAME(knurl_wave_value(&wave, k), paper_square(k, 231, 43));
            }
        }
    }
}

TEST(t2_weights_satisfy_eqs_1_and_2) {
    for (int64_t m = 2007; m < 30000; m += 93) {
        const long double t = (long double)m / 1000.0L;
        const knurl_wave wave = make_wave(KNURL_WAVE_T2, (double)m / 1000.0, 0.7, 1000.0);
        const long double a1 = wave.parts[0].positive;
        const long double a2 = wave.parts[1].positive;
        const long double t1 = wave.parts[0].length;
        const long double t2 = wave.parts[1].length;
        assert_int_equal(wave.part_count, m % 2000 == 0 ? 1 : 2);
        if (wave.part_count == 2) {
            CHECK_CLOSE(t * (a1 / t1 + a2 / t2) / (a1 + a2), 1.0L, 1e-12L);
            CHECK_CLOSE(a1 * a1 + a2 * a2, 0.49L, 1e-14L);
        }
    }
}

TEST(t2_and_t3_follow_algorithms_3_to_6_at_any_period) {
    for (int64_t m = 2000; m <= 24000; m += 13) {
        const knurl_wave t2 = make_wave(KNURL_WAVE_T2, (double)m / 1000.0, 1.05, 1000.0);
        const knurl_wave t3 = make_wave(KNURL_WAVE_T3, (double)m / 1000.0, 1.05, 1000.0);
        for (uint64_t k = 0; k < 50; k++) {
            CHECK_CLOSE(knurl_wave_value(&t2, k), paper_t2(k, m, 1.05), 1e-12L);
            CHECK_CLOSE(knurl_wave_value(&t3, k), paper_t3(k, m, 1.05), 1e-14L);
        }
    }
}

TEST(t2_and_t3_repeat_at_any_tick) {
    const knurl_wave t2 = make_wave(KNURL_WAVE_T2, 7.0, 1.0, 1000.0);
    const knurl_wave t3 = make_wave(KNURL_WAVE_T3, 7.0, 1.0, 1000.0);
    for (uint64_t k = UINT64_MAX - 100; k < UINT64_MAX; k++) {
        CHECK_CLOSE(knurl_wave_value(&t2, k), paper_t2(k, 7000, 1.0L), 1e-14L);
        CHECK_CLOSE(knurl_wave_value(&t3, k), paper_t3(k, 7000, 1.0L), 1e-14L);
    }
}

TEST(below_two_ticks_is_played_as_two_and_marked_above_nyquist) {
    for (int32_t method = KNURL_WAVE_T1; method <= KNURL_WAVE_T3; method++) {
        const knurl_wave fast = make_wave(method, 1.9, 1.0, 1000.0);
        assert_int_equal(fast.above_nyquist, 1);
        CHECK_SAME(fast.period_ticks, 2.0);
        for (uint64_t k = 0; k < 10; k++) {
            CHECK_SAME(knurl_wave_value(&fast, k), paper_square(k, 2, 1));
        }
        for (size_t i = 0; i < COUNT_OF(rates); i++) {
            assert_int_equal(make_wave(method, 2.0, 1.0, rates[i]).above_nyquist, 0);
        }
    }
    assert_int_equal(make_event(1.9, 1.0).above_nyquist, 1);
    assert_int_equal(make_event(1.9, 1.0).length, 2);
    assert_int_equal(make_event(1e-300, 1.0).length, 2);
    assert_int_equal(make_event(2.0, 1.0).above_nyquist, 0);
}

TEST(peaks_are_those_the_header_promises) {
    long double highest[3] = {0.0L, 0.0L, 0.0L};
    for (int64_t m = 2000; m <= 20000; m += 1) {
        for (int32_t method = KNURL_WAVE_T1; method <= KNURL_WAVE_T3; method++) {
            const knurl_wave wave = make_wave(method, (double)m / 1000.0, 1.0, 1000.0);
            for (uint64_t k = 0; k < 24; k++) {
                highest[method - KNURL_WAVE_T1] =
                    fmaxl(highest[method - KNURL_WAVE_T1], fabsl(knurl_wave_value(&wave, k)));
            }
        }
    }
    CHECK_SAME(highest[0], 1.0L);
    CHECK_CLOSE(highest[1], sqrtl(2.0L), 1e-6L); /* reached at 8/3 ticks */
    CHECK_CLOSE(highest[2], (2.0L + 3.0L * sqrtl(2.0L)) / sqrtl(13.0L), 1e-14L);
}

TEST(the_same_number_of_ticks_is_the_same_sequence_at_every_rate) {
    static const double ticks[] = {1.5, 2.0, 2.25, 2.5,        2.75,      3.0, 3.3,  3.5,  4.0,  4.5,
                                   5.0, 7.0, 7.3,  10.0 / 3.0, 8.0 / 3.0, 9.5, 10.0, 23.0, 50.0, 41.0};
    for (size_t i = 0; i < COUNT_OF(ticks) * COUNT_OF(rates); i++) {
        for (int32_t method = KNURL_WAVE_T1; method <= KNURL_WAVE_T3; method++) {
            const knurl_wave here = make_wave(method, ticks[i / 4], 1.0, 1000.0);
            const knurl_wave there = make_wave(method, ticks[i / 4], 1.0, rates[i % 4]);
            for (uint64_t k = 0; k < 500; k++) {
                CHECK_CLOSE(knurl_wave_value(&there, k), knurl_wave_value(&here, k), 1e-12L);
            }
        }
    }
}

TEST(an_event_has_no_height_outside_its_ticks) {
    static const double ticks[] = {2.5, 3.0, 4.0};
    for (size_t i = 0; i < COUNT_OF(ticks); i++) {
        const knurl_vibration_event event = make_event(ticks[i], 1.0);
        CHECK_SAME(knurl_vibration_event_height(&event, -1), 0.0);
        CHECK_SAME(knurl_vibration_event_height(&event, event.length), 0.0);
        CHECK_SAME(knurl_vibration_event_height(&event, INT32_MIN), 0.0);
        CHECK_SAME(knurl_vibration_event_height(&event, INT32_MAX), 0.0);
    }
}

TEST(the_ends_of_the_ranges_are_accepted) {
    knurl_wave wave;
    for (int32_t method = KNURL_WAVE_T1; method <= KNURL_WAVE_T3; method++) {
        assert_int_equal(knurl_wave_prepare(method, 10.0, 0.0, 1.0, &wave), KNURL_OK);
        CHECK_SAME(knurl_wave_value(&wave, 3), 0.0);
        assert_int_equal(knurl_wave_prepare(method, 10.0, 1.0, 100000.0, &wave), KNURL_OK);
        CHECK_SAME(knurl_wave_value(&wave, 499999), 1.0);
        CHECK_SAME(knurl_wave_value(&wave, 500000), -1.0);
        CHECK_SAME(knurl_wave_value(&wave, 1000000), 1.0);
    }
    assert_int_equal(make_event(1e6, 1.0).length, 1000000);
}

TEST(bad_waves_are_refused_and_nothing_is_written) {
    static const double bad[][3] = {{0.0, 1.0, 1000.0},
                                    {-0.003, 1.0, 1000.0},
                                    {(double)NAN, 1.0, 1000.0},
                                    {10.001, 1.0, 1000.0},
                                    {(double)INFINITY, 1.0, 1000.0},
                                    {0.003, -1.0, 1000.0},
                                    {0.003, (double)NAN, 1000.0},
                                    {0.003, (double)INFINITY, 1000.0},
                                    {0.003, 1.0, 0.0},
                                    {0.003, 1.0, 0.999},
                                    {0.003, 1.0, -1000.0},
                                    {0.003, 1.0, 100000.1},
                                    {0.003, 1.0, 1e9},
                                    {0.003, 1.0, (double)NAN},
                                    {0.003, 1.0, (double)INFINITY}};
    knurl_wave wave;
    memset(&wave, 0xA5, sizeof(wave));
    for (size_t i = 0; i < COUNT_OF(bad) * 3; i++) {
        const double *b = bad[i / 3];
        CHECK_REFUSED(knurl_wave_prepare((int32_t)(i % 3) + KNURL_WAVE_T1, b[0], b[1], b[2], &wave),
                      KNURL_ERROR_ARGUMENT, wave);
    }
    CHECK_REFUSED(knurl_wave_prepare(0, 0.003, 1.0, 1000.0, &wave), KNURL_ERROR_UNKNOWN, wave);
    CHECK_REFUSED(knurl_wave_prepare(4, 0.003, 1.0, 1000.0, &wave), KNURL_ERROR_UNKNOWN, wave);
    CHECK_REFUSED(knurl_wave_prepare(-1, 0.003, 1.0, 1000.0, &wave), KNURL_ERROR_UNKNOWN, wave);
}

TEST(bad_events_are_refused_and_nothing_is_written) {
    static const double bad[][2] = {{0.0, 1.0}, {-3.0, 1.0}, {(double)NAN, 1.0}, {(double)INFINITY, 1.0},
                                    {1e7, 1.0}, {3.0, -1.0}, {3.0, (double)NAN}, {3.0, (double)INFINITY}};
    knurl_vibration_event event;
    memset(&event, 0xA5, sizeof(event));
    for (size_t i = 0; i < COUNT_OF(bad); i++) {
        CHECK_REFUSED(knurl_vibration_event_prepare(bad[i][0], bad[i][1], &event), KNURL_ERROR_ARGUMENT, event);
    }
}

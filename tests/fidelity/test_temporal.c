/* Claims 1, 2 and 5 of the paper: dominant component, net force and correlation of T1, T2 and T3, at 1 kHz and 2 kHz,
 * at which all is the same at half the period. Expected numbers are closed forms, and the printed ones.
 * SPDX-License-Identifier: MIT */
#include "support/close.h"

#include <knurl/vibration.h>
#include <metrics.h>

#define PI 3.141592653589793

static const double rates[] = {1000.0, 2000.0};

/* The paper's periods, ticks: 2.5, and the whole ones from 2 to 35. */
#define PERIODS 35

static double period_at(int i) {
    return i == 0 ? 2.5 : (double)(i + 1);
}

static study_signal play(int32_t method, double ticks, double amplitude, double rate) {
    knurl_wave wave;
    study_signal signal;
    assert_int_equal(knurl_wave_prepare(method, ticks / rate, amplitude, rate, &wave), KNURL_OK);
    assert_int_equal(study_signal_of_wave(&wave, rate, &signal), 1);
    return signal;
}

static double net_of(int32_t method, double ticks, double amplitude, double rate) {
    study_signal signal = play(method, ticks, amplitude, rate);
    const double net = study_net(&signal);
    study_signal_free(&signal);
    return net;
}

/* The dominant component, A = 1; its frequency as a period in ticks. */
static double dominant_of(int32_t method, double ticks, double rate, double *period) {
    study_signal signal = play(method, ticks, 1.0, rate);
    study_line line;
    assert_int_equal(study_dominant(&signal, &line), 1);
    study_signal_free(&signal);
    *period = rate / line.frequency;
    return line.amplitude;
}

static double pcc_of(int32_t first, int32_t second, double ticks, double rate) {
    study_signal a = play(first, ticks, 1.0, rate);
    study_signal b = play(second, ticks, 1.0, rate);
    const double pcc = study_pcc(&a, &b);
    study_signal_free(&a);
    study_signal_free(&b);
    return pcc;
}

static void check_dominant(int32_t method, double ticks, double amplitude, double period, double tolerance) {
    for (size_t r = 0; r < COUNT_OF(rates); r++) {
        double found;
        CHECK_CLOSE(dominant_of(method, ticks, rates[r], &found), amplitude, tolerance);
        CHECK_CLOSE(found, period, 1e-9);
    }
}

/* Claim 1. */
TEST(even_periods_have_the_ideal_fundamental_in_every_method) {
    for (int n = 2; n <= 34; n += 2) {
        for (int32_t method = KNURL_WAVE_T1; method <= KNURL_WAVE_T3; method++) {
            check_dominant(method, n, 4.0 / PI, n, 1e-12);
            for (size_t r = 0; r < COUNT_OF(rates); r++) {
                CHECK_CLOSE(net_of(method, n, 1.0, rates[r]), 0.0, 1e-15);
                CHECK_CLOSE(pcc_of(KNURL_WAVE_T1, method, n, rates[r]), 1.0, 1e-12);
            }
        }
    }
}

/* Claim 2, net force. */
TEST(t1_nets_a_over_n_at_odd_periods_and_a_fifth_at_2_5) {
    for (size_t r = 0; r < COUNT_OF(rates); r++) {
        for (int n = 3; n <= 35; n += 2) {
            CHECK_CLOSE(net_of(KNURL_WAVE_T1, n, 1.05, rates[r]), 1.05 / n, 1e-14);
        }
        CHECK_CLOSE(net_of(KNURL_WAVE_T1, 2.5, 1.05, rates[r]), 1.05 / 5.0, 1e-14);
        for (int i = 1; i < PERIODS; i++) { /* "as much as 1/3" */
            assert_true(net_of(KNURL_WAVE_T1, period_at(i), 1.0, rates[r]) <= 1.0 / 3.0 + 1e-14);
        }
    }
}

TEST(t2_and_t3_have_no_net_force) {
    for (size_t r = 0; r < COUNT_OF(rates); r++) {
        for (int tenths = 20; tenths <= 350; tenths++) {
            CHECK_CLOSE(net_of(KNURL_WAVE_T2, tenths / 10.0, 1.0, rates[r]), 0.0, 1e-13);
            CHECK_CLOSE(net_of(KNURL_WAVE_T3, tenths / 10.0, 1.0, rates[r]), 0.0, 1e-13);
        }
    }
}

/* Claim 2, correlation. */
TEST(t1_and_t3_correlate_fully_at_every_whole_period) {
    for (size_t r = 0; r < COUNT_OF(rates); r++) {
        for (int n = 2; n <= 35; n++) {
            CHECK_CLOSE(pcc_of(KNURL_WAVE_T1, KNURL_WAVE_T3, n, rates[r]), 1.0, 1e-12);
        }
    }
}

/* T2's 3/sqrt(13) and T3's 2/sqrt(13) of the same 2-tick wave: 6/13, printed 0.46; T1's five ticks share no line with
 * four or six. */
TEST(at_2_5_ticks_t2_and_t3_are_the_most_alike) {
    for (size_t r = 0; r < COUNT_OF(rates); r++) {
        CHECK_CLOSE(pcc_of(KNURL_WAVE_T2, KNURL_WAVE_T3, 2.5, rates[r]), 6.0 / 13.0, 1e-12);
        CHECK_CLOSE(6.0 / 13.0, 0.46, 0.005);
        CHECK_CLOSE(pcc_of(KNURL_WAVE_T1, KNURL_WAVE_T2, 2.5, rates[r]), 0.0, 1e-12);
        CHECK_CLOSE(pcc_of(KNURL_WAVE_T1, KNURL_WAVE_T3, 2.5, rates[r]), 0.0, 1e-12);
    }
}

/* T2 plays N - 1 and N + 1 ticks, which have no line of N's: it differs fully. */
TEST(t2_shares_nothing_with_the_others_at_odd_periods) {
    for (size_t r = 0; r < COUNT_OF(rates); r++) {
        for (int n = 3; n <= 35; n += 2) {
            CHECK_CLOSE(pcc_of(KNURL_WAVE_T1, KNURL_WAVE_T2, n, rates[r]), 0.0, 1e-12);
            CHECK_CLOSE(pcc_of(KNURL_WAVE_T3, KNURL_WAVE_T2, n, rates[r]), 0.0, 1e-12);
        }
    }
}

/* Claim 2, dominant component. (N + 1)/2 ticks of +A and (N - 1)/2 of -A, held: 4/pi cos(pi/2N). */
TEST(t1_lies_below_the_ideal_by_a_cosine_at_odd_periods) {
    for (int n = 3; n <= 35; n += 2) {
        check_dominant(KNURL_WAVE_T1, n, 4.0 / PI * cos(PI / (2.0 * n)), n, 1e-12);
    }
}

/* T3 is T1 scaled by T/(2 sqrt(Tp Tn)), which is N/sqrt(N^2 - 1). */
TEST(t3_is_t1_scaled_and_still_below_the_ideal) {
    for (int n = 3; n <= 35; n += 2) {
        const double expected = 4.0 / PI * cos(PI / (2.0 * n)) * n / sqrt((double)n * n - 1.0);
        assert_true(expected < 4.0 / PI);
        check_dominant(KNURL_WAVE_T3, n, expected, n, 1e-12);
    }
}

/* Eqs. 3 and 4 at odd N: the part of N + 1 ticks has (N + 1)/sqrt(2 N^2 + 2) of A, and is the larger. */
TEST(t2_is_dominated_by_the_even_period_above_odd_ones) {
    for (int n = 3; n <= 35; n += 2) {
        check_dominant(KNURL_WAVE_T2, n, 4.0 / PI * (n + 1.0) / sqrt(2.0 * n * n + 2.0), n + 1.0, 1e-12);
    }
}

TEST(t2_is_below_the_ideal_at_every_period_that_is_not_even) {
    double period;
    for (size_t r = 0; r < COUNT_OF(rates); r++) {
        for (int tenths = 20; tenths <= 350; tenths++) {
            const double amplitude = dominant_of(KNURL_WAVE_T2, tenths / 10.0, rates[r], &period);
            assert_true(tenths % 20 == 0 || amplitude < 4.0 / PI - 1e-6);
        }
    }
}

/* T1: five ticks + + - + -, whose second line is 8/5 sin(3 pi/5)/(2 sin(pi/5)) before the hold. T2: 3/sqrt(13) of 2
 * ticks. T3: 3/sqrt(13) of its own 3 ticks. */
TEST(at_2_5_ticks_t2_is_the_nearest_to_the_ideal) {
    const double hold = sin(0.4 * PI) / (0.4 * PI);
    const double t1 = 0.8 * sin(0.6 * PI) / sin(0.2 * PI) * hold;
    const double t2 = 4.0 / PI * 3.0 / sqrt(13.0);
    const double t3 = 4.0 / PI * cos(PI / 6.0) * 3.0 / sqrt(8.0) * 3.0 / sqrt(13.0);
    check_dominant(KNURL_WAVE_T1, 2.5, t1, 2.5, 1e-12);
    check_dominant(KNURL_WAVE_T2, 2.5, t2, 2.0, 1e-12);
    check_dominant(KNURL_WAVE_T3, 2.5, t3, 3.0, 1e-12);
    assert_true(t2 > t1 && t2 > t3 && t2 < 4.0 / PI);
}

TEST(dominant_components_are_the_printed_ones) {
    static const struct {
        double ticks;
        double amplitude[3];
        double period[3];
    } cells[] = {{2.5, {0.9797, 1.0594, 0.9731}, {2.5, 2.0, 3.0}},
                 {3.0, {1.1027, 1.1388, 1.1695}, {3.0, 4.0, 3.0}},
                 {5.0, {1.2109, 1.0594, 1.2359}, {5.0, 6.0, 5.0}}};
    for (size_t i = 0; i < COUNT_OF(cells); i++) {
        for (int m = 0; m < 3; m++) {
            check_dominant(KNURL_WAVE_T1 + m, cells[i].ticks, cells[i].amplitude[m], cells[i].period[m], 0.5e-4);
        }
    }
}

/* Claim 5: A_F = (4/pi) A is the fundamental; A_E = sqrt(2) A has the signal's energy, which is A^2 in every method. */
TEST(a_square_wave_is_a_sinusoid_of_4_over_pi_or_of_root_2) {
    for (size_t r = 0; r < COUNT_OF(rates); r++) {
        for (int i = 0; i < PERIODS; i++) {
            for (int32_t method = KNURL_WAVE_T1; method <= KNURL_WAVE_T3; method++) {
                study_signal signal = play(method, period_at(i), 0.7, rates[r]);
                CHECK_CLOSE(sqrt(2.0) * study_rms(&signal), sqrt(2.0) * 0.7, 1e-13);
                study_signal_free(&signal);
            }
        }
        study_signal square = play(KNURL_WAVE_T1, 20.0, 0.7, rates[r]);
        CHECK_CLOSE(study_line_amplitude(&square, 1), 4.0 / PI * 0.7, 1e-13);
        study_signal_free(&square);
    }
}

/* Claim 4 of the paper: the frequencies that can be played without a step that a hand feels, at 1 kHz and at 2 kHz, at
 * which all are twice as high. Expected numbers: f_h/N computed here with integers, and the paper's.
 * SPDX-License-Identifier: MIT */
#include "support/close.h"

#include <coverage.h>
#include <knurl/vibration.h>

static const double rates[] = {1000.0, 2000.0};

typedef struct reachable {
    study_reach list[STUDY_MAX_REACH];
    size_t count;
} reachable;

static reachable reach_of(double rate, int set) {
    reachable r;
    r.count = study_reachable(rate, 20.0, set, r.list);
    return r;
}

static double no_gap_up_to(double rate, int set, double weber) {
    const reachable r = reach_of(rate, set);
    return study_no_gap_up_to(r.list, r.count, weber);
}

TEST(even_periods_reach_half_the_rate_over_whole_numbers) {
    for (size_t i = 0; i < COUNT_OF(rates); i++) {
        const reachable r = reach_of(rates[i], STUDY_SET_EVEN);
        const size_t lowest = (size_t)(rates[i] / 40.0); /* 20 Hz is 25 pairs of ticks at 1 kHz */
        assert_int_equal(r.count, lowest);
        for (size_t k = 0; k < r.count; k++) {
            CHECK_CLOSE(r.list[k].frequency, rates[i] / (2.0 * (double)(lowest - k)), 1e-9);
            assert_int_equal(r.list[k].kind, KNURL_EVENT_EVEN);
        }
    }
}

TEST(odd_periods_fill_in_the_rate_over_every_whole_number) {
    for (size_t i = 0; i < COUNT_OF(rates); i++) {
        const reachable r = reach_of(rates[i], STUDY_SET_ODD);
        const size_t lowest = (size_t)(rates[i] / 20.0);
        assert_int_equal(r.count, lowest - 1);
        for (size_t k = 0; k < r.count; k++) {
            CHECK_CLOSE(r.list[k].frequency, rates[i] / (double)(lowest - k), 1e-9);
        }
    }
}

TEST(the_mixed_case_adds_one_frequency_at_2_5_ticks) {
    for (size_t i = 0; i < COUNT_OF(rates); i++) {
        const reachable with = reach_of(rates[i], STUDY_SET_MIXED);
        const reachable without = reach_of(rates[i], STUDY_SET_ODD);
        assert_int_equal(with.count, without.count + 1);
        CHECK_SAME(with.list[with.count - 2].frequency, 0.4 * rates[i]); /* 400 Hz; 800 Hz at 2 kHz (section V) */
        assert_int_equal(with.list[with.count - 2].kind, KNURL_EVENT_MIXED);
        CHECK_SAME(with.list[with.count - 1].frequency, 0.5 * rates[i]);
    }
}

/* 166.7 Hz x 1.38 = 230 Hz, and the next even period is 250 Hz. */
TEST(even_periods_alone_leave_no_haptic_gap_up_to_230_hz) {
    for (size_t i = 0; i < COUNT_OF(rates); i++) {
        CHECK_CLOSE(no_gap_up_to(rates[i], STUDY_SET_EVEN, 0.38), 230.0 * rates[i] / 1000.0, 1e-9);
    }
}

/* 333.3 Hz x 1.38 = 460 Hz; the printed 461 is 1.383 of it. 230 and 461 as printed, rounded, are one Weber fraction:
 * 0.3815 to 0.3830. */
TEST(odd_periods_leave_no_gap_up_to_460_hz_and_461_hz_with_0_383) {
    for (size_t i = 0; i < COUNT_OF(rates); i++) {
        const double scale = rates[i] / 1000.0;
        CHECK_CLOSE(no_gap_up_to(rates[i], STUDY_SET_ODD, 0.38), 460.0 * scale, 1e-9);
        CHECK_CLOSE(no_gap_up_to(rates[i], STUDY_SET_ODD, 0.383), 461.0 * scale, 1e-9);
        CHECK_CLOSE(no_gap_up_to(rates[i], STUDY_SET_ODD, 0.382), 461.0 * scale, 0.5 * scale);
        CHECK_CLOSE(no_gap_up_to(rates[i], STUDY_SET_EVEN, 0.382), 230.0 * scale, 0.5 * scale);
    }
}

TEST(the_mixed_case_closes_the_last_gap_up_to_500_hz) {
    study_gap gaps[STUDY_MAX_REACH];
    for (size_t i = 0; i < COUNT_OF(rates); i++) {
        const reachable r = reach_of(rates[i], STUDY_SET_MIXED);
        assert_int_equal(study_gaps(r.list, r.count, 0.38, STUDY_GAP_NEIGHBOUR, gaps), 0);
        CHECK_SAME(no_gap_up_to(rates[i], STUDY_SET_MIXED, 0.38), 0.5 * rates[i]);
        /* and needs no less than 0.25 for it: 400 to 500 Hz */
        assert_int_equal(study_gaps(r.list, r.count, 0.2499, STUDY_GAP_NEIGHBOUR, gaps) > 0, 1);
    }
}

TEST(gaps_reach_from_f_1_plus_wf_to_the_neighbour) {
    study_gap gaps[STUDY_MAX_REACH];
    const reachable even = reach_of(1000.0, STUDY_SET_EVEN);
    assert_int_equal(study_gaps(even.list, even.count, 0.38, STUDY_GAP_NEIGHBOUR, gaps), 2);
    CHECK_CLOSE(gaps[0].low, 230.0, 1e-9);
    CHECK_CLOSE(gaps[0].high, 250.0, 1e-9);
    CHECK_CLOSE(gaps[1].low, 345.0, 1e-9);
    CHECK_CLOSE(gaps[1].high, 500.0, 1e-9);
    /* 0.20 is met exactly between 5 and 6 ticks, 166.7 and 200 Hz: not above it, and no gap */
    const reachable odd = reach_of(1000.0, STUDY_SET_ODD);
    assert_int_equal(study_gaps(odd.list, odd.count, 0.20, STUDY_GAP_NEIGHBOUR, gaps), 3);
    CHECK_CLOSE(gaps[0].low, 240.0, 1e-9);
    CHECK_CLOSE(gaps[1].low, 300.0, 1e-9);
    CHECK_CLOSE(gaps[2].low, 400.0, 1e-9);
}

/* The lower fractions of the literature with whole periods only: frequencies within WF of neither neighbour. */
TEST(whole_periods_alone_leave_one_band_unreached_below_0_225) {
    study_gap gaps[STUDY_MAX_REACH];
    for (size_t i = 0; i < COUNT_OF(rates); i++) {
        const double scale = rates[i] / 1000.0;
        const reachable r = reach_of(rates[i], STUDY_SET_ODD);
        assert_int_equal(study_gaps(r.list, r.count, 0.20, STUDY_GAP_UNREACHED, gaps), 1);
        CHECK_CLOSE(gaps[0].low, 400.0 * scale, 1e-9);
        CHECK_CLOSE(gaps[0].high, 416.7 * scale, 0.05 * scale);
        assert_int_equal(study_gaps(r.list, r.count, 0.18, STUDY_GAP_UNREACHED, gaps), 1);
        CHECK_CLOSE(gaps[0].low, 393.0 * scale, 0.5 * scale);
        CHECK_CLOSE(gaps[0].high, 424.0 * scale, 0.5 * scale);
        assert_int_equal(study_gaps(r.list, r.count, 0.225, STUDY_GAP_UNREACHED, gaps), 0);
    }
}

/* The paper gives no audible Weber fraction. Its limits fit a fraction of 5.6 to 5.9 % at
 * 27.8 Hz and 4.2 to 4.3 % at 41.7 Hz: then the first gap is the one that holds 28.8 Hz, or 43.1 Hz (and begins beyond
 * 41.7 Hz, its other number for the same limit). */
TEST(audible_steps_begin_around_28_8_hz_and_43_1_hz) {
    static const struct {
        int set;
        double weber;
        double printed;
        double below;
    } limits[] = {{STUDY_SET_EVEN, 1.0 / 17.5, 28.8, 500.0 / 18.0}, {STUDY_SET_ODD, 1.0 / 23.5, 43.1, 1000.0 / 24.0}};
    study_gap gaps[STUDY_MAX_REACH];
    for (size_t i = 0; i < COUNT_OF(limits); i++) {
        const reachable r = reach_of(1000.0, limits[i].set);
        assert_true(study_gaps(r.list, r.count, limits[i].weber, STUDY_GAP_NEIGHBOUR, gaps) > 0);
        CHECK_CLOSE(gaps[0].low / (1.0 + limits[i].weber), limits[i].below, 1e-9);
        assert_true(limits[i].below < limits[i].printed && limits[i].printed < gaps[0].high);
    }
}

/* 500 Hz and 190 Hz more, 250 mm/s: 0.36 mm, 2.8 per mm; 0.5 mm without the JND. */
TEST(the_smallest_period_at_250_mm_s_is_0_36_mm) {
    for (size_t i = 0; i < COUNT_OF(rates); i++) {
        const double scale = rates[i] / 1000.0;
        const reachable r = reach_of(rates[i], STUDY_SET_MIXED);
        const double top = r.list[r.count - 1].frequency;
        CHECK_CLOSE(0.38 * top, 190.0 * scale, 1e-9);
        CHECK_CLOSE(250.0 / (1.38 * top), 0.36 / scale, 0.005 / scale);
        CHECK_CLOSE(1.38 * top / 250.0, 2.8 * scale, 0.05 * scale);
        CHECK_CLOSE(250.0 / top, 0.5 / scale, 1e-12);
    }
}

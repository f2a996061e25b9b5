/* The paper's claims about gratings, and the last table of shared/paper.md, with numbers from closed forms, at 1 and
 * 2 kHz. SPDX-License-Identifier: MIT */
#include "support/close.h"

#include "grating_metrics.h"

#include <knurl/knurl.h>

#include <stdlib.h>

static const double rates[] = {1000.0, 2000.0};
static const double start[2] = {0.0, 0.0};

/* A straight scan of amplitude 1 over fsx x fsy at velocity (m/s); to be freed. */
static study_scan scan_of(int32_t method, double rate, const double fs[2], const double from[2],
                          const double velocity[2], size_t ticks, int crossed) {
    knurl_grating grating;
    study_scan scan;
    study_motion *motion = malloc(ticks * sizeof *motion);
    assert_non_null(motion);
    memset(&grating, 0, sizeof grating);
    memcpy(grating.spatial_frequency, fs, sizeof grating.spatial_frequency);
    grating.amplitude = 1.0;
    grating.update_rate_hz = rate;
    grating.method = method;
    assert_int_equal(knurl_grating_check(&grating), KNURL_OK);
    study_motion_line(from, velocity, rate, motion, ticks);
    assert_true(study_scan_run(&grating, motion, ticks, crossed, &scan));
    free(motion);
    return scan;
}

/* Straight across a 1024 cycles/m grating (exact phases) at a period in ticks. */
static study_scan across(int32_t method, double rate, double period_ticks, size_t ticks) {
    static const double fs[2] = {1024.0, 0.0};
    const double from[2] = {0.1 / 1024.0, 0.0};
    const double velocity[2] = {rate / period_ticks / 1024.0, 0.0};
    return scan_of(method, rate, fs, from, velocity, ticks, STUDY_CROSSED_PATH);
}

TEST(s2_drifts_by_period_over_length) {
    /* an event of N ticks while T were crossed: T/N - 1; the mix plays 2.4 cycles in 6 ticks: T/2.5 - 1 */
    static const struct {
        double period, length; /* length: ticks a cycle played */
    } cases[] = {{3.5 - 1e-6, 3.0}, {3.5, 4.0},  {4.5 - 1e-6, 4.0},  {4.5, 5.0},   {2.25 - 1e-6, 2.0}, {2.25, 2.5},
                 {2.5, 2.5},        {2.75, 2.5}, {2.75 + 1e-6, 3.0}, {10.5, 11.0}, {2.0, 2.0},         {7.0, 7.0}};
    for (size_t i = 0; i < 2 * COUNT_OF(cases); i++) {
        study_scan scan = across(KNURL_METHOD_S2, rates[i % 2], cases[i / 2].period, 6000);
        CHECK_CLOSE(study_scan_drift(&scan), cases[i / 2].period / cases[i / 2].length - 1.0, 1e-8L);
        study_scan_free(&scan);
    }
}

TEST(s2_drift_at_three_and_a_half_ticks_is_the_papers) {
    for (size_t i = 0; i < COUNT_OF(rates); i++) {
        study_scan below = across(KNURL_METHOD_S2, rates[i], 3.5 - 1e-6, 6000);
        study_scan at = across(KNURL_METHOD_S2, rates[i], 3.5, 6000);
        CHECK_CLOSE(study_scan_drift(&below), 1.0 / 6.0, 1e-6L);
        CHECK_CLOSE(study_scan_drift(&at), -0.125, 1e-8L);
        /* missing cycles are dropouts; extra ones do not count */
        CHECK_CLOSE(study_scan_dropout(&below), 0.0, 0.0L);
        CHECK_CLOSE(study_scan_dropout(&at), 0.125, 0.001L); /* 3428 half cycles, the edge of the count is 2 of them */
        /* 6000 ticks: 2000 events against 6000/3.5 cycles, 1500 against as many */
        CHECK_CLOSE(study_scan_phase_error(&below), 2000.0 - 6000.0 / 3.5, 1e-3L);
        CHECK_CLOSE(study_scan_phase_error(&at), 6000.0 / 3.5 - 1500.0, 1e-5L);
        study_scan_free(&below);
        study_scan_free(&at);
    }
}

TEST(s1_keeps_step_below_half_the_update_rate) {
    for (size_t i = 0; i < COUNT_OF(rates); i++) {
        for (int step = 0; step < 44; step++) {
            const double period = 2.03 * pow(1.07, step);
            study_scan scan = across(KNURL_METHOD_S1, rates[i], period, 5000);
            CHECK_CLOSE(study_scan_dropout(&scan), 0.0, 0.0L);
            assert_true(study_scan_phase_error(&scan) <=
                        0.5 + 1e-9 + 1.0 / period); /* an edge waits for the next tick */
            study_scan_free(&scan);
        }
    }
}

TEST(s1_is_silent_at_every_multiple_of_the_update_rate) {
    for (size_t i = 0; i < COUNT_OF(rates); i++) {
        for (int multiple = 1; multiple <= 4; multiple++) {
            study_scan scan = across(KNURL_METHOD_S1, rates[i], 1.0 / multiple, 4096);
            CHECK_SAME(study_scan_dropout(&scan), 1.0);
            CHECK_SAME(scan.played[scan.ticks], 0.0);
            study_scan_free(&scan);
        }
    }
}

TEST(s1_above_half_the_update_rate_plays_the_alias) {
    /* f_t between f_h/2 and f_h folds to f_h - f_t: that many cycles are played, the others drop out */
    static const double shares[] = {0.5625, 0.625, 0.75, 0.875, 0.9375};
    for (size_t i = 0; i < COUNT_OF(shares); i++) {
        study_scan scan = across(KNURL_METHOD_S1, 1000.0, 1.0 / shares[i], 16384);
        CHECK_CLOSE(scan.played[scan.ticks] / 16384.0, 1.0 - shares[i], 1e-4L);
        CHECK_CLOSE(study_scan_dropout(&scan), 1.0 - (1.0 - shares[i]) / shares[i], 1e-3L);
        study_scan_free(&scan);
    }
}

TEST(cells_centres_on_a_diagonal_are_silent) {
    static const double grids[2][2] = {{1024.0, 512.0}, {1024.0, 1024.0}};
    for (size_t i = 0; i < 2 * COUNT_OF(grids); i++) {
        /* fsx vx = fsy vy: 40 Hz along each */
        const double *fs = grids[i / 2];
        const double velocity[2] = {40.0 / fs[0], 40.0 / fs[1]};
        const double aside[2] = {0.1 / fs[0], 0.35 / fs[1]};
        study_scan silent = scan_of(KNURL_METHOD_S1, rates[i % 2], fs, start, velocity, 10000, STUDY_CROSSED_MAP);
        study_scan heard = scan_of(KNURL_METHOD_S1, rates[i % 2], fs, aside, velocity, 10000, STUDY_CROSSED_MAP);
        CHECK_SAME(silent.played[10000], 0.0);
        CHECK_SAME(study_scan_dropout(&silent), 1.0);
        CHECK_CLOSE(heard.crossed[10000], 80.0 * 10000.0 / rates[i % 2], 1e-6L); /* fsx |vx| + fsy |vy| */
        CHECK_CLOSE(heard.played[10000], heard.crossed[10000], 1.0L);
        study_scan_free(&silent);
        study_scan_free(&heard);
    }
}

TEST(eq_11_crosses_as_eq_12_on_the_axes_and_twice_on_the_diagonal) {
    static const double grids[2][2] = {{1024.0, 512.0}, {1024.0, 1024.0}};
    for (size_t g = 0; g < COUNT_OF(grids); g++) {
        const double *fs = grids[g];
        const double velocities[3][2] = {{0.05, 0.0}, {0.0, 0.05}, {40.0 / fs[0], 40.0 / fs[1]}};
        for (int v = 0; v < 3; v++) {
            study_scan map = scan_of(KNURL_METHOD_S1, 1000.0, fs, start, velocities[v], 1000, STUDY_CROSSED_MAP);
            study_scan path = scan_of(KNURL_METHOD_S2, 1000.0, fs, start, velocities[v], 1000, STUDY_CROSSED_PATH);
            CHECK_CLOSE(map.crossed[1000] / path.crossed[1000], v == 2 ? 2.0 : 1.0, 1e-9L);
            study_scan_free(&map);
            study_scan_free(&path);
        }
    }
}

TEST(depth_that_one_sided_contact_needs) {
    /* the lowest trough: A An of Eq. 7 for N = 3 and 5, 2/sqrt(13) + 3 sqrt(2)/sqrt(13) in the mix, A when even */
    const struct {
        double period, trough;
    } cases[] = {{4.0, 1.0}, {3.0, sqrt(2.0)}, {5.0, sqrt(1.5)}, {2.5, (2.0 + 3.0 * sqrt(2.0)) / sqrt(13.0)}};
    for (size_t i = 0; i < 2 * COUNT_OF(cases); i++) {
        const double trough = cases[i / 2].trough;
        const double period = cases[i / 2].period == 2.5 ? 6.0 : cases[i / 2].period;
        /* ticks at the trough: half of an even event, (N - 1)/2 of an odd one, one of the mix */
        const double ticks = cases[i / 2].period == 2.5 ? 1.0 : floor(0.5 * period);
        study_scan scan = across(KNURL_METHOD_S2, rates[i % 2], cases[i / 2].period, 600);
        CHECK_CLOSE(study_scan_net(&scan, 400.0, trough + 1e-3), 0.0, 1e-10L);
        CHECK_CLOSE(study_scan_net(&scan, 400.0, trough - 0.01), 400.0 * 0.01 * ticks / period, 1e-9L);
        study_scan_free(&scan);
    }
}

TEST(s2_freezes_for_the_event_of_its_first_tick) {
    /* 1 mm/s on 2 mm: 2 s; the hand then runs at 250 mm/s and crosses 125 cycles/s that are not played */
    for (size_t i = 0; i < COUNT_OF(rates); i++) {
        const size_t ticks = (size_t)(2.5 * rates[i]);
        const knurl_grating grating = {KNURL_METHOD_S2, {0}, {500.0, 0.0}, 1.0, rates[i], 0.0};
        study_motion *motion = calloc(ticks, sizeof *motion);
        study_scan scan;
        assert_non_null(motion);
        for (size_t k = 0; k < ticks; k++) {
            motion[k].velocity[0] = k == 0 ? 0.001 : 0.25;
        }
        assert_true(study_scan_run(&grating, motion, ticks, STUDY_CROSSED_PATH, &scan));
        const size_t event = (size_t)(2.0 * rates[i]);
        CHECK_CLOSE(scan.played[event], 1.0, 1e-9L);
        CHECK_CLOSE(scan.crossed[event], 0.0005 / rates[i] * 1e3 + 125.0 * (2.0 - 1.0 / rates[i]), 1e-6L);
        CHECK_CLOSE(scan.height[event - 1], -1.0, 0.0L);
        study_scan_free(&scan);
        free(motion);
    }
}

TEST(s2_is_balanced_where_s1_pushes) {
    /* claim 2 in space: A/3 at 3 ticks, A/5 at 5 and at 2.5 for S1, which is T1; nothing for S2 */
    static const struct {
        double period, net;
    } cases[] = {{3.0, 1.0 / 3.0}, {5.0, 0.2}, {2.5, 0.2}, {4.0, 0.0}};
    for (size_t i = 0; i < 2 * COUNT_OF(cases); i++) {
        const double rate = rates[i % 2];
        study_scan s1 = across(KNURL_METHOD_S1, rate, cases[i / 2].period, 600);
        study_scan s2 = across(KNURL_METHOD_S2, rate, cases[i / 2].period, 600);
        CHECK_CLOSE(fabs(study_scan_net(&s1, 1.0, 3.0)), cases[i / 2].net, 1e-12L);
        CHECK_CLOSE(study_scan_net(&s2, 1.0, 3.0), 0.0, 1e-12L);
        CHECK_CLOSE(study_scan_push(&s1, rate / cases[i / 2].period, 60.0 / rate), cases[i / 2].net, 1e-12L);
        study_scan_free(&s1);
        study_scan_free(&s2);
    }
}

TEST(spurious_energy_of_three_ticks_is_a_quarter) {
    /* lines of a 3-tick wave go with 1/q^2 but for every third; the even ones hold a quarter of the sum. 1e-3: lines
     * are summed to 10 f_h only */
    for (size_t i = 0; i < COUNT_OF(rates); i++) {
        study_scan scan = across(KNURL_METHOD_S2, rates[i], 3.0, 1200);
        CHECK_CLOSE(study_scan_spurious(&scan, rates[i] / 3.0, 0.05), 0.25, 5e-3L);
        study_scan_free(&scan);
        scan = across(KNURL_METHOD_S2, rates[i], 4.0, 1200);
        CHECK_CLOSE(study_scan_spurious(&scan, rates[i] / 4.0, 0.05), 0.0, 1e-6L);
        study_scan_free(&scan);
    }
}

TEST(dropout_is_what_comes_a_half_cycle_late_or_never) {
    /* a half cycle crossed a tick; played: no half cycle before tick 6, then three at once, then one per tick */
    double crossed[11];
    double played[11];
    double height[10] = {0.0};
    study_scan scan = {height, crossed, played, NULL, NULL, 10, 10, 1000.0, 0};
    for (int k = 0; k <= 10; k++) {
        crossed[k] = 0.5 * k;
        played[k] = k < 6 ? 0.0 : 0.5 * (k - 3);
    }
    /* 0 to 4 are lost; 5, 6, 7 by the three, then one more a tick, each a half cycle early: 8, 9, 10, 11 */
    CHECK_CLOSE(study_scan_dropout(&scan), 5.0 / 12.0, 1e-12L);
    for (int k = 0; k <= 10; k++) {
        played[k] = 0.5 * k; /* in step */
    }
    CHECK_SAME(study_scan_dropout(&scan), 0.0);
    for (int k = 0; k <= 10; k++) {
        played[k] = fmin(k, 5.0); /* two per tick up to tick 5, then no more: 0 to 6 count, the rest was too early */
    }
    CHECK_CLOSE(study_scan_dropout(&scan), 2.0 / 9.0, 1e-12L);
}

/* The chart of velocity estimators, and its measurements against closed forms.
 * SPDX-License-Identifier: MIT */
#include "support/close.h"

#include "velocity.h"

#define COUNT 0.055e-3 /* m: the Touch's encoders */
#define FINE  0.01e-3

static const double speeds[] = {0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5};

static velocity_errors measured(const char *name, double resolution, double rate, double speed) {
    velocity_errors e;
    const velocity_contender *c = velocity_contenders;
    while (c->name && strcmp(c->name, name) != 0) {
        c++;
    }
    assert_non_null(c->name);
    assert_int_equal(velocity_measure(c, resolution, rate, speed, &e), 0);
    return e;
}

/* Mean of (v / speed)^2 over the runs, whose speeds are spread evenly, and over the wobble. */
static double squares(void) {
    double sum = 0.0;
    for (int i = 0; i < VELOCITY_PHASES; i++) {
        const double apart = (i + 0.5) / VELOCITY_PHASES - 0.5;
        sum += pow(1.0 + 2.0 * VELOCITY_SPREAD * apart, 2.0) / VELOCITY_PHASES;
    }
    return sum * (1.0 + 0.5 * VELOCITY_WOBBLE * VELOCITY_WOBBLE);
}

/* rms error of an estimator that outputs a pulse for each crossed count, with squares that sum to `power` (counts per
 * tick), if pulses do not overlap: p counts per tick, so p power - p^2. */
static double pulsed(double speed, double rate, double power) {
    const double tick = COUNT * rate; /* a count a tick, m/s */
    return sqrt(speed * tick * power - speed * speed * squares());
}

TEST(a_difference_is_late_by_half_a_tick_and_pulses_by_a_count_a_tick) {
    for (size_t i = 0; i < 5; i++) { /* to 20 mm/s: less than a count a tick */
        const velocity_errors e = measured("difference", COUNT, 1000.0, speeds[i]);
        CHECK_CLOSE(e.rms, pulsed(speeds[i], 1000.0, 1.0), 0.01L * e.rms);
    }
    CHECK_CLOSE(measured("difference", FINE, 1000.0, 0.5).delay, 0.5e-3, 0.01e-3L);
    CHECK_CLOSE(measured("difference", FINE, 5000.0, 0.5).delay, 0.1e-3, 0.01e-3L);
}

TEST(a_low_pass_is_late_by_its_phase_at_two_strokes_a_second) {
    static const double cutoffs[] = {10.0, 20.0, 40.0};
    static const char *const names[] = {"low pass, 10 Hz", "low pass, 20 Hz", "low pass, 40 Hz"};
    for (size_t i = 0; i < 3; i++) { /* a / (1 - (1 - a) e^(-jw)), and half a tick of the difference */
        const double w = 2.0 * acos(-1.0) * VELOCITY_STROKE_HZ / 1000.0;
        const double b = exp(-2.0 * acos(-1.0) * cutoffs[i] / 1000.0);
        const double lag = atan2(b * sin(w), 1.0 - b * cos(w)) / w + 0.5; /* ticks */
        CHECK_CLOSE(measured(names[i], FINE, 1000.0, 0.5).delay, 1e-3 * lag, 0.02e-3L);
    }
}

/* If counts are more than 15 ms apart, each is a pulse of 15 samples: 1/15 count a tick as published; by thirds
 * 1, 2, 3, 4, seven times 5, 4, 3, 2, 1 of 55. This is its limit: 1 mm/s is sometimes estimated as 5 mm/s. */
TEST(below_a_count_in_15_ms_every_foaw_pulses) {
    for (size_t i = 0; i < 2; i++) {
        const velocity_errors published = measured("FOAW as published", COUNT, 1000.0, speeds[i]);
        const velocity_errors ours = measured("FOAW", COUNT, 1000.0, speeds[i]);
        CHECK_CLOSE(published.rms, pulsed(speeds[i], 1000.0, 1.0 / 15.0), 0.01L * published.rms);
        CHECK_CLOSE(ours.rms, pulsed(speeds[i], 1000.0, 235.0 / 3025.0), 0.01L * ours.rms);
    }
}

TEST(nothing_is_biased) {
    for (const velocity_contender *c = velocity_contenders; c->name; c++) {
        for (size_t i = 0; i < COUNT_OF(speeds); i++) {
            velocity_errors e;
            assert_int_equal(velocity_measure(c, COUNT, 1000.0, speeds[i], &e), 0);
            CHECK_CLOSE(e.bias, 0.0, 0.02e-3L); /* a count in the 4 s of a run is 0.014 mm/s */
        }
    }
}

/* Why it is the default: less error than FOAW as published and than a low pass that is as late (20 Hz, 7.9 ms), from
 * 5 mm/s on; and from 50 mm/s on it is no later either. */
TEST(thirds_of_foaws_window_are_ahead_from_5_mm_s_on) {
    static const double shares[] = {0.3, 0.3, 0.45, 0.9, 0.75, 0.8, 0.95}; /* of the published one's rms error */
    for (size_t i = 2; i < COUNT_OF(speeds); i++) {
        const velocity_errors ours = measured("FOAW", COUNT, 1000.0, speeds[i]);
        const velocity_errors published = measured("FOAW as published", COUNT, 1000.0, speeds[i]);
        const velocity_errors smooth = measured("low pass, 20 Hz", COUNT, 1000.0, speeds[i]);
        assert_true(ours.rms < shares[i - 2] * published.rms);
        assert_true(ours.rms < 0.9 * smooth.rms);
        assert_true(ours.period_mean < published.period_mean && ours.period_mean < smooth.period_mean);
        if (speeds[i] >= 0.05) {
            assert_true(ours.delay < smooth.delay + 0.1e-3);
        }
        if (speeds[i] >= 0.1) {
            assert_true(ours.delay < published.delay + 0.1e-3);
        }
    }
}

TEST(s2_plays_what_is_crossed_to_1_percent_from_5_mm_s_on) {
    for (size_t i = 2; i < COUNT_OF(speeds); i++) {
        const velocity_errors e = measured("FOAW", COUNT, 1000.0, speeds[i]);
        assert_true(fabs(e.drift) < 0.011);
        assert_true(e.period_mean < (speeds[i] < 0.02 ? 0.08 : 0.03));
    }
}

TEST(ten_kilohertz_is_no_worse_than_one) {
    static const double some[] = {0.005, 0.02, 0.05, 0.2};
    for (size_t i = 0; i < COUNT_OF(some); i++) {
        const velocity_errors slow = measured("FOAW", COUNT, 1000.0, some[i]);
        const velocity_errors fast = measured("FOAW", COUNT, 10000.0, some[i]);
        const velocity_errors published = measured("FOAW as published", COUNT, 10000.0, some[i]);
        CHECK_CLOSE(fast.rms, slow.rms, 0.05L * slow.rms);
        CHECK_CLOSE(fast.delay, slow.delay, 0.1e-3L);
        assert_true(fabs(fast.drift) < 0.011);
        assert_true(published.rms > 9.0 * fast.rms); /* 15 ticks of 10 kHz are 1.5 ms */
    }
}

/* The method LOCKED keeps step where S2 does not: at constant speeds, in strokes from rest, and back over the same
 * ridges. Its two promises stand in shared/design.md; a whole tick either way is f_t/f_h of a cycle, so half a tick's
 * rounding may put an event 0.24 of a cycle out at 0.48 f_h, and no more is allowed than 0.3. KNURL_LONG in the
 * environment: finer steps. SPDX-License-Identifier: MIT */
#include "support/close.h"

#include "locked.h"

#include <stdlib.h>

#define TOUCH 0.055e-3 /* m: the quantum of the paper's device */
#define JND   0.38     /* the paper's haptic Weber fraction */

static double fineness(void) {
    return getenv("KNURL_LONG") ? 0.1 : 1.0;
}

/* LOCKED at a rate, over a grating of 1 mm from ideal positions. */
static locked_scan ideal(double rate) {
    const locked_scan scan = {KNURL_METHOD_LOCKED, rate, 0.001, 0.0, 0.0, 0.0, 0.0, 0.0, 0};
    return scan;
}

static locked_found worst(const locked_scan *scan, double frequency, int starts) {
    locked_found found;
    assert_true(locked_scan_worst(scan, frequency, starts, 0, &found));
    return found;
}

static void check_step(const locked_found *found, double frequency, double bound) {
    if (!(found->step.error <= bound)) {
        fail_msg("%g Hz: %g cycles out", frequency, found->step.error);
    }
}

/* 1000 cycles played or more, so that a quarter of one at either end is within a thousandth. */
static void check_constant_speeds(double rate, double step) {
    const locked_scan scan = ideal(rate);
    for (double f = 20.0; f <= 0.48 * rate; f += step * fineness()) {
        const locked_found found = worst(&scan, f, 3);
        check_step(&found, f, 0.3);
        CHECK_CLOSE(found.step.played / found.step.crossed, 1.0, 1e-3L);
        assert_true(found.step.played > 990.0);
        CHECK_CLOSE(found.unbalanced, 0.0, 1e-12L);
    }
}

TEST(at_constant_speed_each_cycle_crossed_is_played_and_in_step) {
    check_constant_speeds(1000.0, 1.3);
}

TEST(at_2_5_and_10_khz_as_well) {
    check_constant_speeds(2000.0, 9.7);
    check_constant_speeds(5000.0, 37.1);
    check_constant_speeds(10000.0, 83.3);
}

/* A loop that is too slow for the crossover has a lower one. */
TEST(at_500_and_250_hz_as_well) {
    check_constant_speeds(500.0, 1.3);
    check_constant_speeds(250.0, 1.3);
}

/* The JND of the true period, or the whole numbers of ticks either side of it where the JND shuts both out. */
static void check_lengths(double rate, double frequency) {
    const double period = rate / frequency;
    const knurl_grating grating = {KNURL_METHOD_LOCKED, {0}, {1000.0, 0.0}, 1.0, rate, 0.0, 0.0};
    const double velocity[2] = {frequency / 1000.0, 0.0};
    knurl_grating_state s = {0};
    for (int k = 0; k < 3000; k++) {
        const double position[2] = {velocity[0] * k / rate, 0.0};
        const int64_t events = s.event_count;
        knurl_grating_output out;
        knurl_grating_step(&grating, &s, position, velocity, &out);
        const double length = s.event.length;
        if (s.event_count > events && !((length >= period / (1.0 + JND) && length <= period * (1.0 + JND)) ||
                                        length == floor(period) || length == ceil(period))) {
            fail_msg("%g Hz at %g Hz: an event of %g ticks", frequency, rate, length);
        }
    }
    assert_true(s.event_count > 5);
}

TEST(at_constant_speed_no_event_is_longer_or_shorter_than_can_be_felt) {
    static const double rates[] = {1000.0, 2000.0, 5000.0, 10000.0};
    for (size_t i = 0; i < COUNT_OF(rates); i++) {
        for (double f = KNURL_LOCKED_CROSSOVER_HZ; f <= 0.48 * rates[i]; f += rates[i] / 530.0 * fineness()) {
            check_lengths(rates[i], f);
        }
    }
}

/* What LOCKED is for: the paper's method drifts at constant speed, most just below 3.5 ticks, by a sixth. */
TEST(s2_loses_step_at_constant_speed) {
    locked_scan scan = ideal(1000.0);
    scan.method = KNURL_METHOD_S2;
    const locked_found found = worst(&scan, 1000.0 / 3.4999, 3);
    CHECK_CLOSE(found.step.played / found.step.crossed, 7.0L / 6.0L, 1e-3L);
    assert_true(found.step.error > 100.0);
}

/* Without events only edges are counted, and an S1 that does not alias has each of them in its tick. */
TEST(what_follows_the_position_is_never_out) {
    locked_scan scan = ideal(1000.0);
    scan.method = KNURL_METHOD_S1;
    for (double f = 20.0; f < 490.0; f += 9.7) {
        const locked_found found = worst(&scan, f, 3);
        check_step(&found, f, 1e-9);
        CHECK_CLOSE(found.step.played / found.step.crossed, 1.0, 1e-3L);
    }
}

static const double tops[] = {100.0, 250.0, 400.0, 480.0};
static const double periods[] = {0.0005, 0.001, 0.002};
static const double repeats[] = {0.5, 1.0, 2.0};

/* All strokes: from rest to a top frequency and back, forwards only or to and fro. Returns the worst. */
static double check_strokes(int32_t method, double quantum, int turns, int starts, double bound) {
    double most = 0.0;
    for (size_t i = 0; i < COUNT_OF(tops) * COUNT_OF(periods) * COUNT_OF(repeats); i++) {
        locked_scan scan = ideal(1000.0);
        scan.method = method;
        scan.period = periods[i / COUNT_OF(tops) % COUNT_OF(periods)];
        scan.per_second = repeats[i / COUNT_OF(tops) / COUNT_OF(periods)];
        scan.quantum = quantum;
        scan.turns = turns;
        scan.start = 0.013;
        const locked_found found = worst(&scan, tops[i % COUNT_OF(tops)], (int)(starts / fineness()));
        check_step(&found, tops[i % COUNT_OF(tops)], bound);
        most = fmax(most, found.step.error);
        assert_true(method != KNURL_METHOD_LOCKED || found.step.longest <= 50.0);
        CHECK_CLOSE(found.unbalanced, 0.0, method == KNURL_METHOD_LOCKED ? 1e-12L : 1e-11L); /* S2's are 2000 ticks long */
    }
    return most;
}

TEST(in_strokes_from_rest_it_is_in_step_all_the_way) {
    (void)check_strokes(KNURL_METHOD_LOCKED, 0.0, 0, 10, 0.3);
}

TEST(in_strokes_to_and_fro_as_well) {
    (void)check_strokes(KNURL_METHOD_LOCKED, 0.0, 1, 10, 0.3);
}

TEST(from_an_encoders_counts_it_is_within_half_a_cycle) {
    (void)check_strokes(KNURL_METHOD_LOCKED, TOUCH, 0, 10, 0.5);
    (void)check_strokes(KNURL_METHOD_LOCKED, TOUCH, 1, 10, 0.5);
}

TEST(s2_is_out_by_hundreds_of_cycles_in_strokes) {
    assert_true(check_strokes(KNURL_METHOD_S2, 0.0, 0, 2, 1e9) > 100.0);
}

/* The chart of `knurl study locked` in one line: 120 Hz is high enough, half of it is not. */
TEST(the_crossover_is_where_events_begin_to_keep_up_with_a_stroke) {
    locked_scan scan = ideal(1000.0);
    scan.per_second = 2.0;
    scan.quantum = TOUCH;
    assert_true(worst(&scan, 480.0, 10).step.error < 0.5);
    scan.crossover = 0.5 * KNURL_LOCKED_CROSSOVER_HZ;
    assert_true(worst(&scan, 480.0, 10).step.error > 1.0);
}

/* The measure itself, on heights without events of four ticks a cycle. */
static study_step step_of(double *height) {
    double phase[400];
    double within[400];
    const study_scan scan = {height, phase, phase, within, within, 400, 400, 1000.0, 0};
    for (int k = 0; k < 400; k++) {
        phase[k] = 0.25 * k;
        within[k] = -1.0;
    }
    return study_scan_step(&scan, phase);
}

TEST(the_measure_tells_a_cycle_too_few_or_too_many) {
    double height[400];
    for (int k = 0; k < 400; k++) {
        height[k] = k % 4 < 2 ? 1.0 : -1.0;
    }
    study_step step = step_of(height);
    CHECK_CLOSE(step.error, 0.0, 1e-12L);
    CHECK_CLOSE(step.played - step.crossed, 0.0, 1e-12L);
    height[200] = height[201] = -1.0; /* a ridge is left out */
    step = step_of(height);
    CHECK_CLOSE(step.error, 0.75, 1e-12L); /* at tick 203, at 50.75: what is felt was over at 50 */
    CHECK_CLOSE(step.played - step.crossed, -1.0, 1e-12L);
    height[200] = height[201] = 1.0; /* and a notch too many */
    height[101] = -1.0;
    height[102] = 1.0;
    step = step_of(height);
    CHECK_CLOSE(step.played - step.crossed, 1.0, 1e-12L);
    assert_true(step.error >= 0.75);
}

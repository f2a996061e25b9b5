/* Metrics of steady scans, of sums of sines whose shares are known. SPDX-License-Identifier: MIT */
#include "steady.h"
#include "support/close.h"

#define RATE  1000.0
#define TICKS 1000
#define PI    3.141592653589793

/* A sine at `hz`, one of `other_hz`, and a constant. */
static steady_metrics measure(double hz, double size, double other_hz, double other, double push) {
    double heights[TICKS];
    steady_metrics found;
    for (int k = 0; k < TICKS; k++) {
        const double t = k / RATE;
        heights[k] = size * sin(2.0 * PI * hz * t + 0.4) + other * sin(2.0 * PI * other_hz * t) + push;
    }
    assert_true(steady_measure(heights, TICKS, RATE, hz, &found));
    return found;
}

TEST(the_push_is_the_mean_over_whole_cycles) {
    CHECK_CLOSE(measure(100.0, 1.0, 30.0, 0.0, 0.07).push, 0.07, 1e-9);
    CHECK_CLOSE(measure(100.0, 1.0, 30.0, 0.0, -0.07).push, 0.07, 1e-9);
    CHECK_CLOSE(measure(100.0, 1.0, 30.0, 0.0, 0.0).push, 0.0, 1e-9);
}

TEST(the_level_is_that_of_the_line) {
    CHECK_CLOSE(measure(137.0, 1.2, 61.0, 0.3, 0.1).level, 1.2, 1e-9);
}

/* Hann's window attenuates a line with the cube of its distance: 137 bins here. */
TEST(the_mean_does_not_depend_on_the_last_cycles_cut) {
    CHECK_CLOSE(measure(137.37, 1.0, 30.0, 0.0, -0.07).mean, 0.07, 1e-6);
    CHECK_CLOSE(measure(137.37, 1.0, 30.0, 0.0, 0.0).mean, 0.0, 1e-6);
}

TEST(the_crest_is_the_largest_height) {
    CHECK_CLOSE(measure(250.0, 0.0, 250.0, 1.2, -0.1).crest, 1.3, 1e-9); /* 0, 1.2, 0, -1.2 */
}

TEST(false_tones_are_a_share_of_the_power) {
    CHECK_CLOSE(measure(137.0, 1.0, 61.0, 0.2, 0.1).false_tones, 0.04 / 1.04, 1e-4);
    CHECK_CLOSE(measure(137.0, 1.0, 3.0 * 137.0, 0.2, 0.1).false_tones, 0.0, 1e-4); /* a square wave has it too */
    CHECK_CLOSE(measure(137.0, 0.0, 0.0, 0.0, 0.1).false_tones, 1.0, 1e-12);        /* no vibration at all */
}

/* 5 % of 200 Hz are 10 Hz, of 30 Hz 1.5 Hz, of which 4 are made; a line is 2 Hz wide here. */
TEST(a_tone_is_false_that_is_more_than_5_percent_and_4_hz_away) {
    CHECK_CLOSE(measure(200.0, 1.0, 208.0, 0.5, 0.0).false_tones, 0.0, 1e-3);
    CHECK_CLOSE(measure(200.0, 1.0, 212.0, 0.5, 0.0).false_tones, 0.25 / 1.25, 1e-3);
    CHECK_CLOSE(measure(200.0, 1.0, 588.0, 0.5, 0.0).false_tones, 0.25 / 1.25, 1e-3); /* folded: 412 Hz */
    CHECK_CLOSE(measure(30.0, 1.0, 32.0, 0.5, 0.0).false_tones, 0.0, 1e-3);
    CHECK_CLOSE(measure(30.0, 1.0, 36.0, 0.5, 0.0).false_tones, 0.25 / 1.25, 1e-3);
}

/* 700 N/m less 45 g at the circular frequency's square, 5.5 N s/m: at 20 Hz 19.7 N/m are left of the first, 691 of the
 * second. 250 Hz: 110334 and 8639; the threshold is 1 there, 6.25^2 at 20 Hz and 4 at 500 Hz. */
TEST(the_felt_strength_is_the_motion_over_the_threshold) {
    CHECK_CLOSE(steady_felt_weight(250.0), 1.0 / hypot(110333.05, 8639.38), 1e-10);
    CHECK_CLOSE(steady_felt_weight(20.0), 1.0 / hypot(-10.612, 691.15) / 39.0625, 1e-7);
    CHECK_CLOSE(steady_felt_weight(500.0), 1.0 / hypot(443432.2, 17278.8) / 4.0, 1e-10);
    CHECK_CLOSE(steady_felt_weight(8.0), 0.0, 0.0);
}

/* A sine at f has an image at f_h - f, which the hold leaves f/(f_h - f) of. */
TEST(the_holds_image_is_felt) {
    const double image = 400.0 / 600.0 * steady_felt_weight(600.0) / steady_felt_weight(400.0);
    const steady_metrics m = measure(400.0, 1.0, 30.0, 0.0, 0.0);
    CHECK_CLOSE(m.felt_false, image * image / (1.0 + image * image), 1e-4);
    CHECK_CLOSE(m.false_tones, 0.0, 1e-6);
}

TEST(the_strongest_line_is_found_between_two_bins) {
    CHECK_CLOSE(measure(137.37, 1.0, 30.0, 0.2, 0.1).dominant, 137.37, 1e-3);
    CHECK_CLOSE(measure(137.0, 1.0, 212.6, 1.5, 0.1).dominant, 212.6, 1e-3);
}

/* The rms in a window of n ticks at t: a sine's square is 1/2 less a half of a cosine of twice its frequency, and two
 * sines' product a half of the difference's cosine less a half of the sum's. Their means over the window are closed. */
static double window_mean(double hz, double phase, int n, double t) {
    const double x = PI * hz / RATE;
    return cos(2.0 * PI * hz * (t + 0.5 * (n - 1)) / RATE + phase) * sin(n * x) / (n * sin(x));
}

static double beat(int n) {
    double mean = 0.0, square = 0.0;
    for (int t = 0; t <= TICKS - n; t++) {
        const double power = 0.5 - 0.5 * window_mean(400.0, 0.8, n, t) + 0.02 - 0.02 * window_mean(480.0, 0.0, n, t) +
                             0.2 * window_mean(40.0, -0.4, n, t) - 0.2 * window_mean(440.0, 0.4, n, t);
        mean += sqrt(power) / (TICKS - n + 1);
        square += power / (TICKS - n + 1);
    }
    return sqrt(square / (mean * mean) - 1.0);
}

TEST(a_beat_wavers) {
    const steady_metrics m = measure(200.0, 1.0, 240.0, 0.2, 0.0);
    CHECK_CLOSE(m.wavering, beat(12), 1e-6);
    CHECK_CLOSE(m.wavering_50, beat(50), 1e-6);
    CHECK_CLOSE(measure(250.0, 1.0, 240.0, 0.0, 0.0).wavering, 0.0, 1e-6); /* 12 ms are three cycles */
}

/* T1 at 3 ticks is 1, 1, -1: its line is 2 |1 + z - z^2| / 3 with z = exp(-2 pi i / 3), 4/3; its mean is 1/3. */
TEST(a_wave_of_three_ticks_has_the_line_and_the_push_of_its_three_values) {
    static const double cycle[3] = {1.0, 1.0, -1.0};
    double heights[1002];
    steady_metrics found;
    for (int k = 0; k < 1002; k++) {
        heights[k] = cycle[k % 3];
    }
    assert_true(steady_measure(heights, 1002, RATE, RATE / 3.0, &found));
    CHECK_CLOSE(found.level, 4.0 / 3.0, 1e-9);
    CHECK_CLOSE(found.push, 1.0 / 3.0, 1e-9);
    CHECK_CLOSE(found.wavering, 0.0, 1e-6);
}

/* Separates a cosine and a sine, pure and mixed. */
TEST(a_line_has_a_cosine_and_a_sine) {
    double heights[TICKS];
    double line[2];
    for (int k = 0; k < TICKS; k++) {
        const double angle = 2.0 * PI * 70.0 * k / RATE;
        heights[k] = 0.3 * cos(angle) - 0.8 * sin(angle) + 0.2;
    }
    steady_line(heights, TICKS, RATE, 70.0, line);
    CHECK_CLOSE(line[0], 0.3, 1e-9);
    CHECK_CLOSE(line[1], -0.8, 1e-9);
}

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

TEST(what_pushes_is_the_mean_over_whole_cycles) {
    CHECK_CLOSE(measure(100.0, 1.0, 30.0, 0.0, 0.07).push, 0.07, 1e-9);
    CHECK_CLOSE(measure(100.0, 1.0, 30.0, 0.0, -0.07).push, 0.07, 1e-9);
    CHECK_CLOSE(measure(100.0, 1.0, 30.0, 0.0, 0.0).push, 0.0, 1e-9);
}

TEST(the_level_is_that_of_the_line) {
    CHECK_CLOSE(measure(137.0, 1.2, 61.0, 0.3, 0.1).level, 1.2, 1e-9);
}

TEST(false_tones_are_a_share_of_the_power) {
    CHECK_CLOSE(measure(137.0, 1.0, 61.0, 0.2, 0.1).spurious, 0.04 / 1.04, 1e-4);
    CHECK_CLOSE(measure(137.0, 1.0, 3.0 * 137.0, 0.2, 0.1).spurious, 0.0, 1e-4); /* a square wave has it too */
    CHECK_CLOSE(measure(137.0, 0.0, 0.0, 0.0, 0.1).spurious, 1.0, 1e-12);        /* no vibration at all */
}

/* Windows of 12.5 ms on a beat of 40 Hz: the mean square is (1 + m^2)/2 + m cos(2 pi 40 t) over half a beat each, which
 * is + 2 m/pi in one and - 2 m/pi in the next. (12 ticks are a little less than half of it.) */
TEST(a_beat_is_uneven) {
    CHECK_CLOSE(measure(200.0, 1.0, 240.0, 0.2, 0.0).unevenness, 0.5 * 0.2 * 2.0 * 2.0 / PI / 1.04, 0.05);
    CHECK_CLOSE(measure(200.0, 1.0, 240.0, 0.0, 0.0).unevenness, 0.0, 0.03);
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
    CHECK_CLOSE(found.unevenness, 0.0, 1e-9);
}

/* A cosine and a sine told apart, whole and mixed. */
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

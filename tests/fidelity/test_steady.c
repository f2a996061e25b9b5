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

/* The gains of even sensation, on the device and hand of the yardstick. SPDX-License-Identifier: MIT */
#include "even.h"
#include "steady.h"
#include "support/close.h"

#include <math.h>

/* The felt strength of a square wave's harmonics below f_h/2, each held for a tick: closed forms. */
static double closed(double hz) {
    double power = 0.0;
    for (double f = hz, n = 1.0; f < 500.0; f += 2.0 * hz, n += 2.0) {
        const double x = 3.141592653589793 * f / 1000.0;
        power += pow(steady_felt_weight(f) / n * sin(x) / x, 2.0);
    }
    return sqrt(power);
}

TEST(with_its_gains_ridges_are_felt_within_0_9_db_from_25_to_300_hz) {
    knurl_gain gains[EVEN_GAINS];
    double least = INFINITY, most = 0.0;
    assert_int_equal(even_find(gains), 0);
    for (int i = 0; i < EVEN_GAINS; i++) {
        assert_true(gains[i].gain > 0.0 && gains[i].gain <= 1.0);
        if (gains[i].hz > 25.0 && gains[i].hz < 300.0) {
            const double felt = gains[i].gain * closed(gains[i].hz);
            least = fmin(least, felt);
            most = fmax(most, felt);
        }
    }
    print_message("%.2f dB\n", 20.0 * log10(most / least));
    assert_true(most < 1.109 * least); /* third harmonics near f_h/2 fade out, those of the closed form do not */
}

/* The gains of even sensation, on the device and hand of the yardstick. SPDX-License-Identifier: MIT */
#include "even.h"
#include "steady.h"
#include "support/close.h"

#include <knurl/hip.h>

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

/* As played, and by the closed form, which has the harmonics near f_h/2 that are faded out when played. */
TEST(with_the_gains_of_its_model_ridges_are_felt_within_0_9_db_from_25_to_300_hz) {
    knurl_gain gains[KNURL_GAINS];
    double least[2] = {INFINITY, INFINITY};
    double most[2] = {0.0, 0.0};
    assert_int_equal(knurl_gains_from_plant(0.045, 0.5, 1000.0, gains), KNURL_OK);
    for (int i = 0; i < KNURL_GAINS; i++) {
        assert_true(gains[i].gain > 0.0 && gains[i].gain <= 1.0);
        const double felt[2] = {gains[i].gain * closed(gains[i].hz), gains[i].gain * even_felt(gains[i].hz)};
        for (int k = 0; k < 2 && gains[i].hz > 25.0 && gains[i].hz < 300.0; k++) {
            least[k] = fmin(least[k], felt[k]);
            most[k] = fmax(most[k], felt[k]);
        }
    }
    for (int k = 0; k < 2; k++) {
        print_message("%.2f dB\n", 20.0 * log10(most[k] / least[k]));
        assert_true(most[k] < 1.109 * least[k]);
    }
}

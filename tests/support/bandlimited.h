/* The method BANDLIMITED, computed in another way: the formulas of its docstring by libm, the mean by samples.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_BANDLIMITED_H
#define KNURL_TEST_BANDLIMITED_H

#include "support/close.h"

#include <knurl/grating.h>

#define BAND_CREST 1.27325      /* A: 4/pi, its highest height */
#define BAND_EXACT 1.2e-5L      /* A: a cosine to 1.3e-6, by the harmonics up to 1 + 3 + 5 times */
#define BAND_MEAN  (2.0 / 4000) /* A: how exact 4000 samples of a mean are */

/** 0 at from, 1 at to: 3 u^2 - 2 u^3. */
static inline double band_fade(double x, double from, double to) {
    const double u = fmax(0.0, fmin(1.0, (x - from) / (to - from)));
    return u * u * (3.0 - 2.0 * u);
}

/** 4/pi (cos a - w/3 cos 3a + w/5 cos 5a), w from 1 at n d = 0.38 to 0 at 0.5. */
static inline double band_harmonics(double phase, double d) {
    const double a = 6.283185307179586 * (phase - floor(phase));
    double sum = 0.0;
    for (int n = 1; n <= 5; n += 2) {
        const double w = n == 1 ? 1.0 : 1.0 - band_fade(n * d, 0.38, 0.5);
        sum += (n == 3 ? -1.0 : 1.0) * w / n * cos(n * a);
    }
    return 1.2732395447351628 * sum;
}

/** The mean of Eq. 11's bars between two phases, by 4000 samples; of one place its height. */
static inline double band_mean(double from, double to) {
    double sum = 0.0;
    for (int i = 0; i < 4000; i++) {
        const double p = from + (i + 0.5) / 4000.0 * (to - from) + 0.25;
        sum += p - floor(p) < 0.5 ? 1.0 : -1.0;
    }
    return sum / 4000.0;
}

/** In A, for d < 1/2: the height at a phase after a tick that started at another, and its uncertainty. */
static inline double band_height(double from, double to, double d, long double *within) {
    const double share = band_fade(d, 0.06, 1.0 / 12.0);
    *within = BAND_EXACT + (share < 1.0 ? BAND_MEAN : 0.0);
    return share < 1.0 ? band_mean(from, to) + share * (band_harmonics(to, d) - band_mean(from, to))
                       : band_harmonics(to, d);
}

/** State of a scan. */
typedef struct band_scan {
    knurl_grating grating;
    knurl_grating_state state;
    knurl_grating_output out;
} band_scan;

static inline band_scan band_on(double fsx, double fsy, double rate, double resolution) {
    band_scan s;
    memset(&s, 0, sizeof s);
    s.grating.spatial_frequency[0] = fsx;
    s.grating.spatial_frequency[1] = fsy;
    s.grating.amplitude = 1.0;
    s.grating.update_rate_hz = rate;
    s.grating.resolution = resolution;
    s.grating.method = KNURL_METHOD_BANDLIMITED;
    assert_int_equal(knurl_grating_check(&s.grating), KNURL_OK);
    return s;
}

/** One tick. Checks that the height is finite and within 4/pi A. position may be null. */
static inline double band_step(band_scan *s, const double *position, double vx, double vy) {
    const double velocity[2] = {vx, vy};
    knurl_grating_step(&s->grating, &s->state, position, velocity, &s->out);
    assert_true(isfinite(s->out.height) && fabs(s->out.height) <= BAND_CREST * s->grating.amplitude);
    return s->out.height;
}

/** The same along x. */
static inline double band_x(band_scan *s, double x, double speed) {
    const double position[2] = {x, 0.0};
    return band_step(s, position, speed, 0.0);
}

#endif

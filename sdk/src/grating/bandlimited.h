/* The method BANDLIMITED: of the square wave's harmonics only those that the update rate can carry, at the phase of the
 * position. No event, no aliasing. Pure; the state is the tracked position, and on a grid an axis and a phase.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_BANDLIMITED_H
#define KNURL_SRC_BANDLIMITED_H

#include "grating/methods.h"

#include "grating/phase.h"

#include <math.h>

/* With d cycles a tick, harmonic n fades out from n d = 0.38 to 0.5, where it would fold back. `knurl study bandlimited`
 * charts other fades: one that begins later makes the level waver more, one that begins earlier loses the third
 * harmonic at speeds at which it is still felt. */
#define KNURL_BAND_FADE_FROM  0.38
#define KNURL_BAND_FADE_UNTIL 0.5

/* Cycles a tick below which the mean over the distance of the tick is played: its edges take a tick, and it swings to A
 * only. From the second on harmonics are: no more than three of them are below f_h/2 there. Between the two both are
 * mixed. */
#define KNURL_BAND_MEAN_UNTIL     0.06
#define KNURL_BAND_HARMONICS_FROM (1.0 / 12.0)

/* A: above f_h/2 the sign changes every tick. The level felt just below is then kept: 4/pi sinc(0.454) 0.79. */
#define KNURL_BAND_ALTERNATING 0.7

/* 4/pi */
#define KNURL_BAND_FUNDAMENTAL 1.2732395447351628

/* cos(2 pi phase) to 7e-9: the odd polynomial of sin(2 pi t) through Chebyshev's points of [-1/4, 1/4]. libm's would
 * differ from library to library. */
static inline double knurl_cosine_of_cycles(double phase) {
    const double t = 0.25 - fabs(phase - knurl_nearest_cycle(phase));
    const double x = t * t;
    const double low = 6.283185280154406 - 41.34168061334649 * x;
    const double high = 81.60247636892437 + x * (39.759827085616394 * x - 76.58117264428655);
    return t * (low + x * x * high);
}

/* The share of a harmonic at n d, 1 to 0. */
static inline double knurl_band_share(double u) {
    const double left = (KNURL_BAND_FADE_UNTIL - u) * (1.0 / (KNURL_BAND_FADE_UNTIL - KNURL_BAND_FADE_FROM));
    const double z = left < 0.0 ? 0.0 : left < 1.0 ? left : 1.0;
    return z * z * (3.0 - 2.0 * z);
}

/* The sum of the first, third and fifth harmonic, in A. d: cycles a tick, at least KNURL_BAND_MEAN_UNTIL. */
static inline double knurl_band_harmonics(double phase, double d) {
    const double c = knurl_cosine_of_cycles(phase);
    double sum = c;
    if (3.0 * d < KNURL_BAND_FADE_UNTIL) {
        const double x = c * c;
        const double third = c * (4.0 * x - 3.0);
        const double fifth = c * (x * (16.0 * x - 20.0) + 5.0);
        sum += knurl_band_share(5.0 * d) * (1.0 / 5.0) * fifth - knurl_band_share(3.0 * d) * (1.0 / 3.0) * third;
    }
    return KNURL_BAND_FUNDAMENTAL * sum;
}

#endif

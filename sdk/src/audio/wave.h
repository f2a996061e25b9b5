/* The height map as a signal: means over distances, filtered to samples. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_WAVE_H
#define KNURL_SRC_WAVE_H

#include <knurl/base.h>

#include <stdint.h>

#define KNURL_WAVE_OVERSAMPLING 8
#define KNURL_WAVE_TAPS         136 /* 8.5 samples to either side */

/* Makes samples from means of eighths of samples: a low pass, then a high pass. */
typedef struct knurl_wave_filter {
    double taps[KNURL_WAVE_TAPS];
    double history[KNURL_WAVE_TAPS]; /* a ring */
    uint32_t next;                   /* next index in the ring */
    uint32_t equal;                  /* number of equal inputs up to the last one */
    double latest;                   /* the last input */
    double decay;                    /* of the high pass, per sample */
    double before, output;           /* the high pass's last input and output */
} knurl_wave_filter;

/* Eq. 11's mean, -1 to 1, over the straight line between two positions, cycles along x and y. 0 if the line is half a
 * cycle or longer, which cannot be heard. */
double knurl_wave_mean(const double from[2], const double to[2]) KNURL_NONBLOCKING;

/* Modified Bessel function of the first kind, order 0, for Kaiser windows. */
double knurl_wave_bessel(double x);

void knurl_wave_filter_init(knurl_wave_filter *filter, double sample_rate_hz);

void knurl_wave_filter_push(knurl_wave_filter *filter, double mean) KNURL_NONBLOCKING;

/* Returns a sample; exactly 0 if the input has been constant for long enough. */
double knurl_wave_filter_pull(knurl_wave_filter *filter) KNURL_NONBLOCKING;

#endif

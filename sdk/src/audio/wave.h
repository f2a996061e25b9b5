/* The height map as a signal: means over distances, and the filters that make samples of them. SPDX-License-Identifier:
 * MIT */
#ifndef KNURL_SRC_WAVE_H
#define KNURL_SRC_WAVE_H

#include <knurl/base.h>

#include <stdint.h>

#define KNURL_WAVE_OVERSAMPLING 8
#define KNURL_WAVE_TAPS         136 /* 8.5 samples to either side */

/* Means of eighths of samples to samples: a low pass, then a high pass. */
typedef struct knurl_wave_filter {
    double taps[KNURL_WAVE_TAPS];
    double history[KNURL_WAVE_TAPS]; /* a ring */
    uint32_t next;                   /* in the ring */
    uint32_t equal;                  /* how many of the latest were the same */
    double latest;                   /* what was pushed */
    double decay;                    /* of the high pass, per sample */
    double before, output;           /* the high pass's latest input and output */
} knurl_wave_filter;

/* Eq. 11's mean, -1 to 1, over the straight line from one position to another, cycles along x and y. Over half a cycle
 * or more, where it cannot be heard, 0. */
double knurl_wave_mean(const double from[2], const double to[2]) KNURL_NONBLOCKING;

void knurl_wave_filter_init(knurl_wave_filter *filter, double sample_rate_hz);

void knurl_wave_filter_push(knurl_wave_filter *filter, double mean) KNURL_NONBLOCKING;

/* A sample from what was pushed; exactly 0 once that has stayed the same for long enough. */
double knurl_wave_filter_pull(knurl_wave_filter *filter) KNURL_NONBLOCKING;

#endif

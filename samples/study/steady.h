/* Metrics of scans at constant speed, from the heights of all ticks: net force, evenness and strength of the ridges,
 * false tones. The hold's images above f_h/2 are the same for every method and are left out.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_STUDY_STEADY_H
#define KNURL_STUDY_STEADY_H

#include <stddef.h>

typedef struct steady_metrics {
    double push;       /**< the mean over blocks of 50 ms (to whole cycles) of |mean height|: what a hand integrates */
    double level;      /**< the line at the frequency; a square wave of 1 has 4/pi */
    double unevenness; /**< standard deviation over mean of the rms in windows of 12.5 ms */
    double spurious;   /**< share of the varying power below f_h/2 that is further than a quarter of the frequency from
                            every odd multiple of it */
} steady_metrics;

/** Measures `ticks` heights at update rate `rate`, scanned at `frequency` Hz. 0: no memory, or no 50 ms of it. */
int steady_measure(const double *heights, size_t ticks, double rate, double frequency, steady_metrics *found);

/** The line at `frequency`: the amplitudes of its cosine and its sine. */
void steady_line(const double *heights, size_t ticks, double rate, double frequency, double line[2]);

#endif

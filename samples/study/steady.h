/* Metrics of scans at constant speed, from the heights of all ticks: net force, evenness and strength of the ridges,
 * and false tones, by power and as they are felt.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_STUDY_STEADY_H
#define KNURL_STUDY_STEADY_H

#include <stddef.h>

/** A line belongs to the ridges if it is within this share of f_t, or this many Hz if that is more, of an odd multiple
 * of f_t. So a tone that beats with the ridges' own line is false. */
#define STEADY_TOLERANCE    0.05
#define STEADY_TOLERANCE_HZ 4.0

typedef struct steady_metrics {
    double push;        /**< the mean over blocks of 50 ms (to whole cycles) of |mean height|: what a hand integrates */
    double mean;        /**< the height that stays over all cycles: |mean|, weighted by Hann's window, so that it does
                             not matter where the last cycle is cut */
    double level;       /**< the line at the frequency; a square wave of 1 has 4/pi */
    double wavering;    /**< standard deviation over mean of the rms in windows of 12 ms */
    double wavering_50; /**< the same of 50 ms */
    double crest;       /**< the largest |height| */
    double dominant;    /**< Hz, of the line up to half the update rate that is the strongest of what is held */
    double false_tones; /**< share of the varying power below half the update rate that belongs to no ridge */
    double felt_false; /**< the same of what a hand feels: steady_felt_weight(), the hold's images up to the update rate
                            included */
    double felt_stylus; /**< the same over lab_threshold(), a stylus's, which rises by 6 dB an octave above 250 Hz */
    double felt_level;  /**< root of the felt power; its unit has no meaning, its ratios have */
} steady_metrics;

/** Measures `ticks` heights at update rate `rate`, scanned at `frequency` Hz. 0: no memory, or no 50 ms of it. */
int steady_measure(const double *heights, size_t ticks, double rate, double frequency, steady_metrics *found);

/** The line at `frequency`: the amplitudes of its cosine and its sine. */
void steady_line(const double *heights, size_t ticks, double rate, double frequency, double line[2]);

/** How much a force at `hz` is felt: the motion that it makes of a device of 45 g with 0.5 N s/m in a hand of 5 N s/m
 * and 700 N/m, over the detection threshold of a fingertip (flat to 40 Hz, -12 dB an octave to 250 Hz and +12 above:
 * Verrillo 1963, as quoted by Gescheider and Verrillo 1979). Nothing up to 8 Hz. A model, not a measurement. */
double steady_felt_weight(double hz);

#endif

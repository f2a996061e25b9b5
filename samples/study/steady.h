/* Metrics of scans at constant speed, from the heights of all ticks: net force, evenness and strength of the ridges,
 * and false tones, by power and as felt.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_STUDY_STEADY_H
#define KNURL_STUDY_STEADY_H

#include <stddef.h>

/** A line belongs to the ridges if it is within this share of f_t, or this many Hz if that is more, of an odd multiple
 * of f_t. So a tone that beats with the ridges' line is false. */
#define STEADY_TOLERANCE    0.05
#define STEADY_TOLERANCE_HZ 4.0

typedef struct steady_metrics {
    double push;     /**< the mean over blocks of 50 ms (to whole cycles) of |mean height|: integrated by a hand */
    double mean;     /**< the mean height over all cycles: |mean|, weighted by Hann's window, so that the end within the
                        last cycle does not matter */
    double level;    /**< the line at the frequency; a square wave of 1 has 4/pi */
    double wavering; /**< standard deviation over mean of the rms in windows of 12 ms */
    double wavering_50; /**< the same of 50 ms */
    double crest;       /**< the largest |height| */
    double dominant;    /**< Hz, of the strongest line of the held signal, up to half the update rate */
    double false_tones; /**< share of the varying power below half the update rate that belongs to no ridge */
    double felt_false;  /**< the same, as felt by a hand: steady_felt_weight(), the hold's images up to the update rate
                             included */
    double felt_stylus; /**< the same over lab_threshold(), a stylus's, which rises by 6 dB an octave above 250 Hz */
    double felt_level;  /**< root of the felt power; only ratios have a meaning */
} steady_metrics;

/** Measures `ticks` heights at update rate `rate`, scanned at `frequency` Hz. 0: out of memory, or less than 50 ms. */
int steady_measure(const double *heights, size_t ticks, double rate, double frequency, steady_metrics *found);

/** The line at `frequency`: the amplitudes of its cosine and its sine. */
void steady_line(const double *heights, size_t ticks, double rate, double frequency, double line[2]);

/** The sensitivity to a force at `hz`: the motion that it causes in a device of 45 g with 0.5 N s/m, held by a hand of
 * 5 N s/m and 700 N/m, over the detection threshold of a fingertip (flat to 40 Hz, -12 dB an octave to 250 Hz and +12
 * above: Verrillo 1963, as quoted by Gescheider and Verrillo 1979). Zero up to 8 Hz. A model, not a measurement. */
double steady_felt_weight(double hz);

#endif

/* How accurate a contender of the study `tradeoff` is, over all its speeds. SPDX-License-Identifier: MIT */
#ifndef KNURL_STUDY_ACCURACY_H
#define KNURL_STUDY_ACCURACY_H

#include "contender.h"

/** Temporal frequencies: 26 from 20 to 440 Hz, not integers; those of the paper's experiments; and 40 from 421 to
 * 499 Hz, at which a wave and its image at f_h - f_t are close at 1 kHz. */
#define ACCURACY_FREQUENCIES 78
#define ACCURACY_FROM        20.0
#define ACCURACY_SPLIT       440.0 /* 0.44 f_h at 1 kHz */
#define ACCURACY_TO          500.0

/** Means and worst values up to ACCURACY_SPLIT; "above": the worst from there to ACCURACY_TO. See steady.h. Values that
 * do not apply to temporal signals are NaN. */
typedef struct accuracy {
    double mean, mean_worst;           /**< A: the mean height */
    double push_worst;                 /**< A: the same over 50 ms */
    double frequency, frequency_worst; /**< |dominant line - f_t| / f_t */
    double false_tones, false_worst, false_above;
    double felt, felt_worst, felt_above; /**< felt power that belongs to no ridge */
    double stylus_worst;                 /**< the same over a stylus's threshold */
    double wavering, wavering_worst, wavering_above, wavering_50_worst;
    double level;      /**< |level / (4/pi) - 1|, mean */
    double felt_range; /**< dB from the weakest to the strongest felt level, from 25 to 470 Hz */
    double crest;      /**< A, the largest */
    double drift;      /**< |played / crossed cycles - 1|, mean */
    double strokes;    /**< the same in strokes from rest to 250 Hz and back */
    double step;       /**< cycles: the worst phase error in strokes, see study_scan_step() */
} accuracy;

/** Returns 0 if memory runs out. */
int accuracy_measure(const study_contender *contender, accuracy *found);

/** Hz; index: below ACCURACY_FREQUENCIES. */
double accuracy_frequency(size_t index);

#endif

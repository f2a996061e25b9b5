/* The paper's experiments, cell by cell, with this code's metrics. SPDX-License-Identifier: MIT */
#ifndef KNURL_STUDY_PREFERENCES_H
#define KNURL_STUDY_PREFERENCES_H

#define PREFERENCE_PERIODS 12
#define PREFERENCE_CELLS   48 /* 12 periods x 2 intensities x with and without sound */
#define PREFERENCE_METRICS 5

/** One cell of figure 8: a published verdict, and the difference in metrics between the other method's medium vibration
 * and T3's. Doubles throughout, so that a column is an array with a stride. */
typedef struct preference_cell {
    double period_ticks;
    double amplitude; /**< N */
    double sound;     /**< 1 with, 0 without (headphones on) */
    double preferred; /**< 1: T3 at 28 of 36 or more; 0: neither method. The counts themselves are not in the text */
    double metric[PREFERENCE_METRICS];
} preference_cell;

/** The names of metric[]. */
extern const char *const preference_metric_names[PREFERENCE_METRICS];

/** Fills in Experiment 1 (T1 against T3) or 2 (T2 against T3). 0: out of memory. */
int preference_cells(int experiment, preference_cell cells[PREFERENCE_CELLS]);

/** One spatial period of Experiment 3: means over steady speeds of 5, 10, ... 250 mm/s, 1 s each. */
typedef struct preference_grating {
    double period_mm;
    double preferred_s2; /**< of 12 subjects, as published */
    double push[2];      /**< S1, S2: study_scan_push(), in A */
    double spurious[2];  /**< share beyond 20 % of f_t from its odd multiples */
    double dropout[2];
    double drift[2]; /**< mean |played/crossed - 1| */
} preference_grating;

/** Fills in Experiment 3. 0: out of memory. */
int preference_gratings(preference_grating gratings[3]);

#endif

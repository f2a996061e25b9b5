/* The catalogue of failures: each failure of each method as a number with its closed form or bound, a trace to draw,
 * the condition that avoids it, and the test that checks it. One row per failure; failures.md is generated from them.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_STUDY_FAILURES_H
#define KNURL_STUDY_FAILURES_H

#include "grating_metrics.h"

#include <stdio.h>

/** Output of a failure's trace; a null stream draws nothing. */
typedef struct failure_sink {
    FILE *csv; /**< rows of id, series, t, value */
    const char *id;
} failure_sink;

typedef struct failure {
    const char *id;     /**< one word, also used in the CSV */
    const char *group;  /**< the method, or "velocity", "wall" */
    const char *name;   /**< the failure, in a few words */
    const char *what;   /**< a sentence that explains it */
    const char *format; /**< of the number, with its unit; one %g-like conversion */
    const char *expect; /**< source of the number: a closed form or a bound */
    const char *avoid;  /**< the condition to keep to */
    const char *axis;   /**< label of t */
    /** Measures the number and draws the trace. 1, or 0 if memory runs out. */
    int (*measure)(const failure_sink *sink, double *number);
} failure;

/** All of them, ended by a null id. The test of the same name in tests/fidelity/test_failures.c checks the number. */
extern const failure failures[];

/** One point of a trace. */
void failure_point(const failure_sink *sink, const char *series, double t, double value);

/** Draws the first `ticks` of a scan: its height in A, and its position on the surface ("cycle"): `cycle` at the start,
 * NaN if it has none. t: ms. */
void failure_draw_heights(const failure_sink *sink, const study_scan *scan, double cycle, size_t ticks);

/** Where failure_across() begins: m along x, and cycles from a ridge's rising edge (Eq. 11). */
#define FAILURE_START 0.000137
#define FAILURE_CYCLE 0.387

/** A straight scan across ridges of 1 mm at temporal frequency f (Hz), 1 kHz. 1, or 0 if memory runs out. */
int failure_across(int32_t method, double f, size_t ticks, study_scan *scan);

/** Draws cycles played and crossed, every `step`-th tick. t: s. */
void failure_draw_cycles(const failure_sink *sink, const study_scan *scan, size_t step);

int failure_s1_pushes(const failure_sink *sink, double *number);
int failure_s1_silent(const failure_sink *sink, double *number);
int failure_s1_alias(const failure_sink *sink, double *number);
int failure_s1_felt(const failure_sink *sink, double *number);
int failure_s1_counts(const failure_sink *sink, double *number);
int failure_s1_diagonal(const failure_sink *sink, double *number);
int failure_s1_grid(const failure_sink *sink, double *number);
int failure_s2_freezes(const failure_sink *sink, double *number);
int failure_s2_drifts(const failure_sink *sink, double *number);
int failure_s2_loses_step(const failure_sink *sink, double *number);
int failure_s2_outlives(const failure_sink *sink, double *number);
int failure_grazed(const failure_sink *sink, double *number);
int failure_band_wavers(const failure_sink *sink, double *number);
int failure_band_image(const failure_sink *sink, double *number);
int failure_band_counts(const failure_sink *sink, double *number);
int failure_band_pitch(const failure_sink *sink, double *number);
int failure_band_loop(const failure_sink *sink, double *number);
int failure_difference(const failure_sink *sink, double *number);
int failure_foaw_pulses(const failure_sink *sink, double *number);
int failure_wall_runaway(const failure_sink *sink, double *number);
int failure_wall_delay(const failure_sink *sink, double *number);
int failure_wall_quantised(const failure_sink *sink, double *number);
int failure_force_limit(const failure_sink *sink, double *number);
int failure_heat(const failure_sink *sink, double *number);
int failure_contact_crack(const failure_sink *sink, double *number);
int failure_contact_winding(const failure_sink *sink, double *number);
int failure_contact_crowd(const failure_sink *sink, double *number);
int failure_contact_visits(const failure_sink *sink, double *number);
int failure_contact_squeezed(const failure_sink *sink, double *number);
int failure_contact_wedge(const failure_sink *sink, double *number);

#endif

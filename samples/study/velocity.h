/* Errors of velocity estimators and their effect on a grating: errors at constant speed, delay in strokes, S2's events
 * on a grating of 1 mm. The hand's speed varies by 2 % at 9 Hz. Runs start at 8 places within a quantum, at 8 speeds
 * around the named one: at 0.055 mm every multiple of 5 mm/s crosses a whole number of quanta in 11 ms, where an
 * estimator over 11 ms happens to make no error.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_STUDY_VELOCITY_H
#define KNURL_STUDY_VELOCITY_H

#include "contender.h"

#include <knurl/knurl.h>

#include <stddef.h>

#define VELOCITY_PERIOD    0.001 /* m: of the grating */
#define VELOCITY_PHASES    8     /* runs per cell */
#define VELOCITY_SPREAD    0.1   /* of the speed: the runs' speeds are spread evenly over it */
#define VELOCITY_WOBBLE    0.02  /* of the speed */
#define VELOCITY_WOBBLE_HZ 9.0
#define VELOCITY_STROKE_HZ 2.0 /* to and fro, to measure the delay */

/** An estimator beside the library's. */
enum { VELOCITY_LOW_PASS = 100 };

/** One estimator of the chart. */
typedef struct velocity_contender {
    const char *name;
    int32_t method;   /**< KNURL_VELOCITY_; KNURL_VELOCITY_AUTO: FOAW as published: any window of up to 15 ticks,
                           at every rate, the slope from its newest to its oldest sample, no backlash; or
                           VELOCITY_LOW_PASS */
    double cutoff_hz; /**< of the low pass */
} velocity_contender;

/** All of them, ended by a null name. */
extern const velocity_contender velocity_contenders[];

/** State of a contender. */
typedef struct velocity_estimator {
    const velocity_contender *contender;
    knurl_velocity estimator;
    double resolution, rate;
    study_low_pass low_pass;
    int64_t counts[16]; /**< FOAW as published: the newest first */
    int seen;           /**< FOAW as published: number of counts */
} velocity_estimator;

/** Starts it. 0, or 1 if the library returns an error. */
int velocity_start(velocity_estimator *e, const velocity_contender *contender, double resolution, double rate);

/** The velocity (m/s) at position x (m), which is a whole number of counts. */
double velocity_of(velocity_estimator *e, double x);

/** The time of a tick of the library's estimator, three axes, ns. Negative if it is not the library's. */
double velocity_cost(const velocity_contender *contender, double resolution, double rate);

typedef struct velocity_errors {
    double bias;         /**< m/s: mean of estimate less truth, at a steady speed */
    double rms;          /**< m/s: of the same */
    double delay;        /**< s: of the estimate behind the truth, in strokes to and fro of this highest speed */
    double period_mean;  /**< |period at an event's start / (1 mm / true speed) - 1|; NaN without events */
    double period_worst; /**< the largest of them */
    double drift;        /**< cycles played over cycles crossed, less 1 */
    double events;       /**< number of events started */
} velocity_errors;

/** Runs a contender at `speed` (m/s) over positions in quanta of `resolution` (m). 0, or 1 if the library returns an
 * error.
 */
int velocity_measure(const velocity_contender *contender, double resolution, double rate, double speed,
                     velocity_errors *out);

#endif

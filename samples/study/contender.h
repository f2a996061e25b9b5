/* The contenders of the study `tradeoff`: a method at an update rate with a velocity estimator. To add a method, add a
 * row to the table in contender.c.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_STUDY_CONTENDER_H
#define KNURL_STUDY_CONTENDER_H

#include <knurl/knurl.h>

#include <stddef.h>

/** Sources of a spatial method's velocity. */
enum { STUDY_IDEAL = 0, STUDY_DIFFERENCE = 1, STUDY_LOWPASS = 2, STUDY_FOAW = 3, STUDY_VELOCITIES = 4 };

typedef struct study_method {
    const char *name;
    int32_t id;        /**< KNURL_WAVE_T1 ... or KNURL_METHOD_S1 ... */
    int spatial;       /**< 1: scans a grating; 0: a temporal signal */
    int uses_velocity; /**< 1: one contender per velocity estimate; 0: FOAW tracks positions in counts
                        */
} study_method;

/** All methods, ended by a null name. */
extern study_method study_methods[];

/** Adds the method of own.c after the others, for this process. Once. Errors: those of knurl_method_add(). */
knurl_result study_add_own(void);

/** One point of the chart. */
typedef struct study_contender {
    const study_method *method;
    double update_rate_hz;
    int velocity;      /**< STUDY_IDEAL to _FOAW */
    double resolution; /**< of the positions, m; 0: ideal */
    double ridge;      /**< m from ridge to ridge */
} study_contender;

/** Fills in contender `index` (0, 1, ...), on ridges of 1 mm; 0 if there are no more. */
int study_contender_at(size_t index, study_contender *contender);

/** "S2 1000 Hz, FOAW from 0.055 mm" */
void study_contender_name(const study_contender *contender, char *name, size_t size);

/** A first-order low pass of differences, to compare with the library's estimators. Zero it before the first tick. */
typedef struct study_low_pass {
    int started;
    double last, smooth; /**< the last position (m) and velocity (m/s) */
} study_low_pass;

/** The velocity (m/s) at position x (m). */
double study_low_pass_tick(study_low_pass *low_pass, double cutoff_hz, double rate, double x);

/** A contender at work on one frequency: a grating scanned at a steady speed, or a temporal signal. */
typedef struct study_rendering {
    study_contender contender;
    double speed; /**< m/s */
    uint64_t tick;
    knurl_wave wave;
    knurl_grating grating;
    knurl_grating_state state;
    knurl_velocity estimator;
    study_low_pass low_pass;
    double cycles_played; /**< events (the 400 Hz mix: 2.4 cycles), or sign changes / 2 */
    double last;
    double within; /**< the share of the event before the last tick; below 0 without an event */
} study_rendering;

/** Starts at `frequency` Hz, amplitude 1. 0, or 1 if the library returns an error. */
int study_rendering_start(study_rendering *r, const study_contender *contender, double frequency);

/** The height of the next tick. This function is timed. */
double study_rendering_tick(study_rendering *r);

/** The same at a given position (m) and speed (m/s), for spatial methods. */
double study_rendering_tick_at(study_rendering *r, double x, double speed);

#endif

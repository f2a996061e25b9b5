/* Where `locked` and the velocities that it is given fail. SPDX-License-Identifier: MIT */
#include "failures.h"
#include "gratings.h"
#include "locked.h"

#include <math.h>
#include <string.h>

#define RESOLUTION 0.055e-3 /* m: the Touch's */

/* Nine ticks a cycle, just below the crossover: five up and four down, as S1 has them. */
int failure_locked_pushes(const failure_sink *sink, double *number) {
    study_scan scan;
    if (!failure_across(KNURL_METHOD_LOCKED, 1000.0 / 9.0, 900, &scan)) {
        return 0;
    }
    *number = fabs(study_scan_net(&scan, 1.0, 2.0));
    failure_draw_heights(sink, &scan, FAILURE_CYCLE, 45);
    study_scan_free(&scan);
    return 1;
}

/* 2 and 3 ticks alternate where 2.5 are meant. */
int failure_locked_dithers(const failure_sink *sink, double *number) {
    study_scan scan;
    if (!failure_across(KNURL_METHOD_LOCKED, 400.0, 2000, &scan)) {
        return 0;
    }
    *number = 100.0 * study_scan_spurious(&scan, 400.0, 0.02);
    failure_draw_heights(sink, &scan, FAILURE_CYCLE, 30);
    study_scan_free(&scan);
    return 1;
}

static double quantise(double x) {
    return floor(x / RESOLUTION + 0.5) * RESOLUTION;
}

/* Strokes of v = vmax |sin(2 pi t)| up to 480 Hz, from a Touch's encoder and FOAW, as in the study `locked`. The number
 * is that of ridges of 0.5 mm; drawn are others too, and what exact positions would give. */
int failure_locked_quantised(const failure_sink *sink, double *number) {
    static const double periods[] = {0.5e-3, 0.7e-3, 1e-3, 1.5e-3, 2e-3, 3e-3};
    for (int quantised = 0; quantised < 2; quantised++) {
        for (size_t i = 0; i < sizeof periods / sizeof *periods; i++) {
            const locked_scan scan = {.method = KNURL_METHOD_LOCKED,
                                      .rate = GRATINGS_RATE,
                                      .period = periods[i],
                                      .quantum = quantised ? RESOLUTION : 0.0,
                                      .per_second = 2.0};
            locked_found found;
            if (!locked_scan_worst(&scan, 480.0, 8, 0, &found)) {
                return 0;
            }
            *number = i == 0 ? found.step.error : *number;
            failure_point(sink, quantised ? "0.055 mm counts, cycles" : "exact", 1e3 * periods[i], found.step.error);
        }
    }
    return 1;
}

/* There and back on a grid: the way back is counted on, so other places are high. */
int failure_locked_grid(const failure_sink *sink, double *number) {
    enum { TICKS = 59 };
    const knurl_grating grating = gratings_make(KNURL_METHOD_LOCKED, 1000.0, 1000.0);
    knurl_grating_state state;
    double there[TICKS];
    double x = 0.0;
    memset(&state, 0, sizeof state);
    *number = 0.0;
    for (int k = 0; k < 2 * TICKS; k++) { /* 50 mm/s: the turn is a tick after the last way there, at 3 cycles */
        const double velocity[2] = {k < TICKS ? 0.05 : -0.05, 0.0};
        const double position[2] = {x, 0.0};
        knurl_grating_output out;
        knurl_grating_step(&grating, &state, position, velocity, &out);
        if (k < TICKS) {
            there[k] = out.height;
        } else if (k > TICKS) { /* the same place */
            *number += out.height * there[2 * TICKS - k] < 0.0 ? 100.0 / (TICKS - 1) : 0.0;
        }
        failure_point(sink, k < TICKS ? "there" : "back", 1e3 * x, out.height);
        x += velocity[0] / GRATINGS_RATE;
    }
    return 1;
}

/* A steady 100 mm/s: the largest f_t that first differences call for on ridges of 1 mm, less the least. */
int failure_difference(const failure_sink *sink, double *number) {
    knurl_velocity estimator;
    double least = HUGE_VAL;
    double most = -HUGE_VAL;
    if (knurl_velocity_init(KNURL_VELOCITY_DIFFERENCE, RESOLUTION, GRATINGS_RATE, &estimator)) {
        return 0;
    }
    for (size_t k = 0; k < 200; k++) {
        const double position[3] = {quantise(0.1 * (double)k / GRATINGS_RATE), 0.0, 0.0};
        double velocity[3];
        knurl_velocity_update(&estimator, position, velocity);
        if (k > 0) {
            least = fmin(least, velocity[0]);
            most = fmax(most, velocity[0]);
        }
        if (k > 0 && k < 60) {
            failure_point(sink, "asked for, Hz", (double)k, 100.0);
            failure_point(sink, "first difference, Hz", (double)k, 1e3 * velocity[0]);
        }
    }
    *number = 1e3 * (most - least);
    return 1;
}

/* A steady 1 mm/s: a count comes every 55 ticks, and a window of 15 ms sees it as a burst. */
int failure_foaw_pulses(const failure_sink *sink, double *number) {
    knurl_velocity estimator;
    *number = 0.0;
    if (knurl_velocity_init(KNURL_VELOCITY_FOAW, RESOLUTION, GRATINGS_RATE, &estimator)) {
        return 0;
    }
    for (size_t k = 0; k < 400; k++) {
        const double position[3] = {quantise(0.001 * (double)k / GRATINGS_RATE), 0.0, 0.0};
        double velocity[3];
        knurl_velocity_update(&estimator, position, velocity);
        *number = k > 100 ? fmax(*number, 1e3 * velocity[0]) : 0.0;
        failure_point(sink, "true, mm/s", (double)k, 1.0);
        failure_point(sink, "FOAW, mm/s", (double)k, 1e3 * velocity[0]);
    }
    return 1;
}

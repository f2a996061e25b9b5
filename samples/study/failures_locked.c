/* Where `locked` and the velocities that it is given fail. SPDX-License-Identifier: MIT */
#include "failures.h"
#include "gratings.h"

#include <math.h>
#include <string.h>

#define PI         3.141592653589793
#define RESOLUTION 0.055e-3 /* m: the Touch's */

/* m along x, and cycles from a ridge's rising edge (Eq. 11) on ridges of 1 mm. */
static const double start[2] = {0.000137, 0.0};
#define CYCLE 0.387

static int across(int32_t method, double f, size_t ticks, study_scan *scan) {
    const knurl_grating grating = gratings_make(method, 1000.0, 0.0);
    const double velocity[2] = {f / 1000.0, 0.0};
    return gratings_scan_line(&grating, start, velocity, ticks, scan);
}

/* Nine ticks a cycle, just below the crossover: five up and four down, as S1 has them. */
int failure_locked_pushes(const failure_sink *sink, double *number) {
    study_scan scan;
    if (!across(KNURL_LOCKED, 1000.0 / 9.0, 900, &scan)) {
        return 0;
    }
    *number = fabs(study_scan_net(&scan, 1.0, 2.0));
    failure_draw_heights(sink, &scan, CYCLE, 45);
    study_scan_free(&scan);
    return 1;
}

/* 2 and 3 ticks alternate where 2.5 are meant. */
int failure_locked_dithers(const failure_sink *sink, double *number) {
    study_scan scan;
    if (!across(KNURL_LOCKED, 400.0, 2000, &scan)) {
        return 0;
    }
    *number = 100.0 * study_scan_spurious(&scan, 400.0, 0.02);
    failure_draw_heights(sink, &scan, CYCLE, 30);
    study_scan_free(&scan);
    return 1;
}

static double quantise(double x) {
    return floor(x / RESOLUTION + 0.5) * RESOLUTION;
}

/* Strokes of v = vmax |sin(2 pi t)| up to 480 Hz over ridges of 0.5 mm, from a Touch's encoder and FOAW. Phase error:
 * cycles played, to the tick within an event, less cycles crossed; outside events the position's own quantum. */
int failure_locked_quantised(const failure_sink *sink, double *number) {
    enum { TICKS = 1000 };
    const double fs = 2000.0;
    const double vmax = 480.0 / fs;
    knurl_grating grating = gratings_make(KNURL_LOCKED, fs, 0.0);
    grating.resolution = RESOLUTION;
    *number = 0.0;
    for (int phase = 0; phase < 8; phase++) {
        knurl_grating_state state;
        knurl_velocity estimator;
        memset(&state, 0, sizeof state);
        if (knurl_velocity_init(KNURL_VELOCITY_FOAW, RESOLUTION, GRATINGS_RATE, &estimator)) {
            return 0;
        }
        for (size_t k = 0; k < TICKS; k++) {
            const double turn = 2.0 * (double)k / GRATINGS_RATE;
            const double x =
                0.0000137 * phase + vmax / (2.0 * PI) * (2.0 * floor(turn) + 1.0 - cos(PI * (turn - floor(turn))));
            const double position[3] = {quantise(x), 0.0, 0.0};
            double velocity[3];
            knurl_grating_output out;
            knurl_velocity_update(&estimator, position, velocity);
            knurl_grating_step(&grating, &state, position, velocity, &out);
            const double in_event = (double)(state.next_tick - 1) / (state.event.length > 0 ? state.event.length : 1);
            const double played = out.event == KNURL_NO_EVENT ? state.phase : state.played - 1.0 + in_event;
            const double error = played - (fs * x + 0.25);
            *number = fmax(*number, fabs(error));
            if (phase == 0) {
                failure_point(sink, "cycles played less crossed", (double)k, error);
            }
        }
    }
    return 1;
}

/* There and back on a grid: the way back is counted on, so other places are high. */
int failure_locked_grid(const failure_sink *sink, double *number) {
    enum { TICKS = 59 };
    const knurl_grating grating = gratings_make(KNURL_LOCKED, 1000.0, 1000.0);
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

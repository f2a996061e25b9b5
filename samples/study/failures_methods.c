/* Failures of S1 and S2, at 1 kHz with everything else ideal. SPDX-License-Identifier: MIT */
#include "failures.h"
#include "gratings.h"
#include "steady.h"

#include <math.h>
#include <stdlib.h>

#define PI 3.141592653589793

int failure_s1_pushes(const failure_sink *sink, double *number) {
    study_scan scan;
    if (!failure_across(KNURL_METHOD_S1, 1000.0 / 3.0, 300, &scan)) {
        return 0;
    }
    *number = fabs(study_scan_net(&scan, 1.0, 2.0));
    failure_draw_heights(sink, &scan, FAILURE_CYCLE, 24);
    study_scan_free(&scan);
    return 1;
}

int failure_s1_silent(const failure_sink *sink, double *number) {
    study_scan scan;
    if (!failure_across(KNURL_METHOD_S1, 1000.0, 300, &scan)) {
        return 0;
    }
    *number = 100.0 * study_scan_dropout(&scan);
    failure_draw_heights(sink, &scan, FAILURE_CYCLE, 12);
    study_scan_free(&scan);
    return 1;
}

int failure_s1_alias(const failure_sink *sink, double *number) {
    study_scan scan;
    if (!failure_across(KNURL_METHOD_S1, 900.0, 1000, &scan)) {
        return 0;
    }
    *number = scan.played[scan.ticks]; /* cycles in a second */
    failure_draw_heights(sink, &scan, FAILURE_CYCLE, 24);
    study_scan_free(&scan);
    return 1;
}

int failure_s1_felt(const failure_sink *sink, double *number) {
    study_scan scan;
    steady_metrics found;
    if (!failure_across(KNURL_METHOD_S1, 389.0, 1000, &scan)) {
        return 0;
    }
    const int measured = steady_measure(scan.height, scan.ticks, GRATINGS_RATE, 389.0, &found);
    *number = measured ? 100.0 * found.felt_false : NAN;
    failure_draw_heights(sink, &scan, FAILURE_CYCLE, 36);
    study_scan_free(&scan);
    return measured;
}

/* A second at 10 kHz and 10 mm/s over ridges of 0.5 mm, in counts. */
int failure_s1_counts(const failure_sink *sink, double *number) {
    enum { TICKS = 11000 }; /* 22 ridges: 11 are 100 counts */
    const knurl_grating grating = {
        .spatial_frequency = {2000.0, 0.0}, .amplitude = 1.0, .update_rate_hz = 10000.0, .method = KNURL_METHOD_S1};
    study_motion *motion = calloc(TICKS, sizeof *motion);
    study_scan scan;
    if (!motion) {
        return 0;
    }
    for (size_t k = 0; k < TICKS; k++) {
        motion[k].position[0] = 0.055e-3 * floor((FAILURE_START + 1e-6 * (double)k) / 0.055e-3 + 0.5);
        motion[k].velocity[0] = 0.01;
    }
    const int made = study_scan_run(&grating, motion, TICKS, STUDY_CROSSED_PATH, &scan);
    free(motion);
    if (!made) {
        return 0;
    }
    *number = study_scan_push(&scan, 20.0, 0.05);
    for (size_t k = 0; k < 2500; k += 10) {
        failure_point(sink, "height", 0.1 * (double)k, scan.height[k]);
    }
    study_scan_free(&scan);
    return 1;
}

/* Through the cells' centres, at which the signs of both cosines change together. */
int failure_s1_diagonal(const failure_sink *sink, double *number) {
    const knurl_grating grating = gratings_make(KNURL_METHOD_S1, 1000.0, 1000.0);
    const double from[2] = {0.0, 0.0};
    const double velocity[2] = {0.05, 0.05};
    study_scan scan;
    if (!gratings_scan_line(&grating, from, velocity, 1000, &scan)) {
        return 0;
    }
    *number = scan.played[scan.ticks];
    failure_draw_heights(sink, &scan, NAN, 60);
    study_scan_free(&scan);
    return 1;
}

/* Two edges in one tick cancel. */
int failure_s1_grid(const failure_sink *sink, double *number) {
    static const double start[2] = {FAILURE_START, 0.0};
    const knurl_grating grating = gratings_make(KNURL_METHOD_S1, 1000.0, 1000.0);
    *number = 0.0;
    for (int degrees = 1; degrees < 90; degrees++) {
        const double angle = degrees * PI / 180.0;
        const double velocity[2] = {0.1 * cos(angle), 0.1 * sin(angle)};
        study_scan scan;
        if (!gratings_scan_line(&grating, start, velocity, 10000, &scan)) {
            return 0;
        }
        const double lost = 1.0 - scan.played[scan.ticks] / scan.crossed[scan.ticks];
        if (degrees == 40) {
            failure_draw_heights(sink, &scan, NAN, 60);
        }
        *number = fmax(*number, 100.0 * lost);
        study_scan_free(&scan);
    }
    return 1;
}

/* From rest to 250 mm/s in half a second, over ridges of 2 mm. */
int failure_s2_freezes(const failure_sink *sink, double *number) {
    enum { TICKS = 2600 };
    const knurl_grating grating = gratings_make(KNURL_METHOD_S2, 500.0, 0.0);
    study_motion *motion = calloc(TICKS, sizeof *motion);
    study_scan scan;
    double x = 0.0;
    if (!motion) {
        return 0;
    }
    for (size_t k = 0; k < TICKS; k++) {
        motion[k].position[0] = x;
        motion[k].velocity[0] = fmin(0.25, 0.5 * (double)k / GRATINGS_RATE);
        x += motion[k].velocity[0] / GRATINGS_RATE;
    }
    const int made = study_scan_run(&grating, motion, TICKS, STUDY_CROSSED_PATH, &scan);
    free(motion);
    if (!made) {
        return 0;
    }
    size_t k = 2; /* the first event begins here, at 1 mm/s */
    while (k < TICKS && scan.played[k] < 1.0 - 1e-9) {
        k++;
    }
    *number = (double)(k - 2) / GRATINGS_RATE;
    failure_draw_cycles(sink, &scan, 20);
    study_scan_free(&scan);
    return 1;
}

int failure_s2_drifts(const failure_sink *sink, double *number) {
    study_scan scan;
    if (!failure_across(KNURL_METHOD_S2, 1000.0 / (3.5 * (1.0 - 1e-9)), 3000, &scan)) {
        return 0;
    }
    *number = 100.0 * study_scan_drift(&scan);
    failure_draw_heights(sink, &scan, 0.0, 42);
    study_scan_free(&scan);
    return 1;
}

/* v = vmax |sin(pi t)|, f_t up to 480 Hz on 1 mm. */
int failure_s2_loses_step(const failure_sink *sink, double *number) {
    enum { TICKS = 10000 };
    const knurl_grating grating = gratings_make(KNURL_METHOD_S2, 1000.0, 0.0);
    study_motion *motion = calloc(TICKS, sizeof *motion);
    study_scan scan;
    if (!motion) {
        return 0;
    }
    for (size_t k = 0; k < TICKS; k++) {
        const double t = (double)k / GRATINGS_RATE;
        motion[k].velocity[0] = 0.48 * fabs(sin(PI * t));
    }
    const int made = study_scan_run(&grating, motion, TICKS, STUDY_CROSSED_PATH, &scan);
    free(motion);
    if (!made) {
        return 0;
    }
    *number = study_scan_phase_error(&scan);
    failure_draw_cycles(sink, &scan, 50);
    study_scan_free(&scan);
    return 1;
}

/* At 20 Hz the hand stops one tick after an event has begun. */
int failure_s2_outlives(const failure_sink *sink, double *number) {
    enum { TICKS = 80, STOP = 20 }; /* ticks; the first at rest */
    const knurl_grating grating = gratings_make(KNURL_METHOD_S2, 1000.0, 0.0);
    study_motion motion[TICKS] = {{{0.0, 0.0}, {0.0, 0.0}}};
    study_scan scan;
    motion[STOP - 1].velocity[0] = 0.02;
    if (!study_scan_run(&grating, motion, TICKS, STUDY_CROSSED_PATH, &scan)) {
        return 0;
    }
    size_t last = 0;
    for (size_t k = 0; k < TICKS; k++) {
        last = scan.height[k] != 0.0 ? k : last;
        failure_point(sink, "height", (double)k, scan.height[k]);
        failure_point(sink, "speed, 20 mm/s", (double)k, motion[k].velocity[0] / 0.02);
    }
    *number = (double)(last + 1 - STOP) / GRATINGS_RATE * 1e3;
    study_scan_free(&scan);
    return 1;
}

/* Eq. 9 cuts the troughs off: at zero depth only the crests are left. */
int failure_grazed(const failure_sink *sink, double *number) {
    study_scan scan;
    if (!failure_across(KNURL_METHOD_S2, 1000.0 / 3.0, 300, &scan)) {
        return 0;
    }
    *number = study_scan_net(&scan, 1.0, 0.0);
    for (size_t k = 0; k < 24; k++) {
        failure_point(sink, "height", (double)k, scan.height[k]);
        failure_point(sink, "felt", (double)k, fmax(0.0, scan.height[k]));
    }
    study_scan_free(&scan);
    return 1;
}

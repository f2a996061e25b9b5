/* Where `area` fails. SPDX-License-Identifier: MIT */
#include "failures.h"
#include "gratings.h"
#include "steady.h"

#include <math.h>
#include <string.h>

#define PI       3.141592653589793
#define FAST_HZ  450.0 /* just below where events take over */
#define WHOLE_HZ 250.0 /* four ticks a cycle */
#define LATE_HZ  290.0

/* A second at 1000 ridges a metre from a start in cycles. */
static int scan_area(double frequency, double start, study_scan *scan) {
    const knurl_grating grating = gratings_make(KNURL_METHOD_AREA, 1000.0, 0.0);
    const double from[2] = {1e-3 * start, 0.0};
    const double velocity[2] = {1e-3 * frequency, 0.0};
    return gratings_scan_line(&grating, from, velocity, (size_t)GRATINGS_RATE, scan);
}

int failure_area_wavers(const failure_sink *sink, double *number) {
    study_scan scan;
    steady_metrics found;
    if (!scan_area(FAST_HZ, FAILURE_START, &scan)) {
        return 0;
    }
    const int measured = steady_measure(scan.height, scan.ticks, GRATINGS_RATE, FAST_HZ, &found);
    *number = measured ? 100.0 * found.unevenness : NAN;
    failure_draw_heights(sink, &scan, NAN, 60);
    study_scan_free(&scan);
    return measured;
}

int failure_area_level(const failure_sink *sink, double *number) {
    enum { STARTS = 64 };
    *number = 0.0;
    for (int i = 0; i < STARTS; i++) {
        study_scan scan;
        steady_metrics found;
        if (!scan_area(WHOLE_HZ, i / (double)STARTS, &scan)) {
            return 0;
        }
        scan.height[0] = scan.height[4]; /* the first has no way yet */
        if (steady_measure(scan.height, scan.ticks, GRATINGS_RATE, WHOLE_HZ, &found)) {
            *number = fmax(*number, 100.0 * (found.level * PI / 4.0 - 1.0));
        }
        for (size_t k = 4; k < 28 && i % (STARTS / 8) == 0 && i < STARTS / 4; k++) {
            failure_point(sink, i == 0 ? "on the tick" : "an eighth of a cycle later", (double)k, scan.height[k]);
        }
        study_scan_free(&scan);
    }
    return 1;
}

/* By the phase of the line, against the sine that rises where the surface does. */
int failure_area_lags(const failure_sink *sink, double *number) {
    study_scan scan;
    double along = 0.0;
    double across = 0.0;
    if (!scan_area(LATE_HZ, 0.0, &scan)) {
        return 0;
    }
    for (size_t k = 0; k < scan.ticks; k++) {
        const double cycles = LATE_HZ * (double)k / GRATINGS_RATE + 0.25;
        along += scan.height[k] * sin(2.0 * PI * cycles);
        across += scan.height[k] * cos(2.0 * PI * cycles);
        if (k > 0 && k < 24) {
            failure_point(sink, "height", (double)k, scan.height[k]);
            failure_point(sink, "the place's", (double)k, cycles - floor(cycles) < 0.5 ? 1.0 : -1.0);
        }
    }
    *number = -atan2(across, along) / (2.0 * PI * LATE_HZ) * 1e3;
    study_scan_free(&scan);
    return 1;
}

/* Twice round a rectangle on a grid of 1 mm: how far the phase is from where it was at the same place. */
int failure_area_loop(const failure_sink *sink, double *number) {
    static const int legs[4] = {103, 51, 103, 51}; /* ticks at 100 mm/s */
    static const double ways[4][2] = {{1.0, 0.0}, {0.0, 1.0}, {-1.0, 0.0}, {0.0, -1.0}};
    const knurl_grating grating = gratings_make(KNURL_METHOD_AREA, 1000.0, 1000.0);
    knurl_grating_state state;
    double position[2] = {0.0, 0.0};
    double first = NAN;
    memset(&state, 0, sizeof state);
    for (int leg = 0; leg < 5; leg++) {
        for (int k = 0; k < legs[leg % 4]; k++) { /* the velocity is that of the way to here */
            const double velocity[2] = {0.1 * ways[leg % 4][0], 0.1 * ways[leg % 4][1]};
            knurl_grating_output out;
            position[0] += leg > 0 || k > 0 ? 1e-3 * velocity[0] : 0.0;
            position[1] += 1e-3 * velocity[1];
            knurl_grating_step(&grating, &state, position, velocity, &out);
            first = leg == 0 && k == 1 ? state.phase : first;
            if (leg % 4 == 0 && k > 0 && k < 40) {
                failure_point(sink, leg == 0 ? "first round" : "second", 1e3 * position[0], out.height);
            }
            if (leg == 4 && k == 1) { /* at the place of that tick again */
                const double round = state.phase - first;
                *number = fabs(round - floor(round + 0.5));
            }
        }
    }
    return 1;
}

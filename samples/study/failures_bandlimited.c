/* Cases in which `bandlimited` fails, at 1 kHz with everything else ideal. SPDX-License-Identifier: MIT */
#include "contender.h"
#include "failures.h"
#include "gratings.h"
#include "steady.h"

#include <math.h>
#include <string.h>

#define NEAR_HZ   480.0 /* just below f_h/2 */
#define ABOVE_HZ  700.0
#define COUNTS_HZ (1000.0 / 9.0)

int failure_band_wavers(const failure_sink *sink, double *number) {
    study_scan scan;
    steady_metrics found;
    if (!failure_across(KNURL_METHOD_BANDLIMITED, NEAR_HZ, 1000, &scan)) {
        return 0;
    }
    const int measured = steady_measure(scan.height, scan.ticks, GRATINGS_RATE, NEAR_HZ, &found);
    *number = measured ? 100.0 * found.wavering : NAN;
    failure_draw_heights(sink, &scan, FAILURE_CYCLE, 60);
    study_scan_free(&scan);
    return measured;
}

int failure_band_image(const failure_sink *sink, double *number) {
    study_scan scan;
    steady_metrics found;
    if (!failure_across(KNURL_METHOD_BANDLIMITED, NEAR_HZ, 1000, &scan)) {
        return 0;
    }
    const int measured = steady_measure(scan.height, scan.ticks, GRATINGS_RATE, NEAR_HZ, &found);
    *number = measured ? 100.0 * found.felt_false : NAN;
    failure_draw_heights(sink, &scan, FAILURE_CYCLE, 24);
    study_scan_free(&scan);
    return measured;
}

/* 55.56 mm/s: a tick is 1.01 counts. */
int failure_band_counts(const failure_sink *sink, double *number) {
    static double heights[2000];
    study_contender contender = {
        .update_rate_hz = GRATINGS_RATE, .velocity = STUDY_FOAW, .resolution = 0.055e-3, .ridge = 0.5e-3};
    study_rendering r;
    steady_metrics found;
    for (const study_method *m = study_methods; m->name; m++) {
        contender.method = m->spatial && m->id == KNURL_METHOD_BANDLIMITED ? m : contender.method;
    }
    if (study_rendering_start(&r, &contender, COUNTS_HZ)) {
        return 0;
    }
    for (int k = -200; k < 2000; k++) {
        heights[k > 0 ? k : 0] = study_rendering_tick(&r);
    }
    const int measured = steady_measure(heights, 2000, GRATINGS_RATE, COUNTS_HZ, &found);
    *number = measured ? 100.0 * found.false_tones : NAN;
    for (int k = 0; k < 120; k++) {
        failure_point(sink, "height", k, heights[k]);
    }
    return measured;
}

int failure_band_pitch(const failure_sink *sink, double *number) {
    study_scan scan;
    if (!failure_across(KNURL_METHOD_BANDLIMITED, ABOVE_HZ, 1000, &scan)) {
        return 0;
    }
    *number = scan.played[scan.ticks]; /* cycles in a second */
    failure_draw_heights(sink, &scan, FAILURE_CYCLE, 24);
    study_scan_free(&scan);
    return 1;
}

/* Twice round a rectangle on a grid of 1 mm: the difference of phase at the same place. */
int failure_band_loop(const failure_sink *sink, double *number) {
    static const int legs[4] = {103, 51, 103, 51}; /* ticks at 100 mm/s */
    static const double ways[4][2] = {{1.0, 0.0}, {0.0, 1.0}, {-1.0, 0.0}, {0.0, -1.0}};
    const knurl_grating grating = gratings_make(KNURL_METHOD_BANDLIMITED, 1000.0, 1000.0);
    knurl_grating_state state;
    double position[2] = {0.0, 0.0};
    double first = NAN;
    memset(&state, 0, sizeof state);
    for (int leg = 0; leg < 5; leg++) {
        for (int k = 0; k < legs[leg % 4]; k++) { /* the velocity of the last step */
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

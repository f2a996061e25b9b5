/* Failures of velocity estimators. SPDX-License-Identifier: MIT */
#include "failures.h"
#include "gratings.h"

#include <math.h>

#define RESOLUTION 0.055e-3 /* m: a Touch's */

static double quantise(double x) {
    return floor(x / RESOLUTION + 0.5) * RESOLUTION;
}

/* A steady 100 mm/s: the largest f_t from first differences on ridges of 1 mm, less the smallest. */
int failure_difference(const failure_sink *sink, double *number) {
    knurl_velocity estimator;
    double least = HUGE_VAL;
    double most = -HUGE_VAL;
    if (knurl_velocity_prepare(KNURL_VELOCITY_DIFFERENCE, RESOLUTION, GRATINGS_RATE, &estimator)) {
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
    if (knurl_velocity_prepare(KNURL_VELOCITY_FOAW, RESOLUTION, GRATINGS_RATE, &estimator)) {
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

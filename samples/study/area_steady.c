/* Study `area`: all methods at constant speeds: net force, strength and evenness of the ridges, false tones.
 * SPDX-License-Identifier: MIT */
#include "area_parts.h"

#include "gratings.h"
#include "steady.h"

#define FS       1000.0
#define FIRST_HZ 20.0
#define STEP_HZ  5.0
#define COUNT    96 /* to 495 Hz */
#define STARTS   5  /* has no factor with cycles of 2, 4 or 8 ticks */

/* The mean over starts. 0: no memory. */
static int measure(int32_t method, double frequency, steady_metrics *mean) {
    const knurl_grating grating = gratings_make(method, FS, 0.0);
    const double velocity[2] = {frequency / FS, 0.0};
    *mean = (steady_metrics){0.0, 0.0, 0.0, 0.0};
    for (int i = 0; i < STARTS; i++) {
        const double start[2] = {(0.013 + i / (double)STARTS) / FS, 0.0};
        steady_metrics one;
        study_scan scan;
        if (!gratings_scan_line(&grating, start, velocity, 2 * (size_t)GRATINGS_RATE, &scan)) {
            return 0;
        }
        const int done = /* the second second: S2's first event is over */
            steady_measure(scan.height + scan.ticks / 2, scan.ticks / 2, GRATINGS_RATE, frequency, &one);
        study_scan_free(&scan);
        if (!done) {
            return 0;
        }
        mean->push += one.push / STARTS;
        mean->level += one.level / STARTS;
        mean->unevenness += one.unevenness / STARTS;
        mean->spurious += one.spurious / STARTS;
    }
    return 1;
}

int area_steady(json_writer *json) {
    static const int32_t methods[] = {KNURL_METHOD_S1, KNURL_METHOD_S2, KNURL_METHOD_LOCKED, KNURL_METHOD_AREA};
    static steady_metrics rows[COUNT];
    double frequencies[COUNT];
    json_open(json, "steady", '[');
    for (size_t m = 0; m < sizeof methods / sizeof *methods; m++) {
        for (int i = 0; i < COUNT; i++) {
            frequencies[i] = FIRST_HZ + STEP_HZ * i;
            if (!measure(methods[m], frequencies[i], &rows[i])) {
                return 1;
            }
        }
        const size_t stride = sizeof *rows / sizeof(double);
        json_open(json, NULL, '{');
        json_string(json, "method", knurl_method_name(methods[m]));
        json_numbers(json, "hz", frequencies, COUNT, 1);
        json_numbers(json, "push", &rows[0].push, COUNT, stride);
        json_numbers(json, "level", &rows[0].level, COUNT, stride);
        json_numbers(json, "unevenness", &rows[0].unevenness, COUNT, stride);
        json_numbers(json, "spurious", &rows[0].spurious, COUNT, stride);
        json_close(json, '}');
    }
    json_close(json, ']');
    return 0;
}

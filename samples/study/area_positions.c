/* Study `area`: the positions that AREA is given, raw or smoothed by a velocity estimate.
 * SPDX-License-Identifier: MIT */
#include "area_parts.h"

#include "gratings.h"
#include "steady.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define PERIOD_M    0.001
#define FREQUENCIES 16
#define STARTS      4
#define DRAW        0.1 /* a ms: how fast positions draw the filtered way back */

/* Ticks of about a second, after a tenth of one. quantum: m, 0 is exact. */
static int scan(double rate, double quantum, int filtered, double frequency, double start, steady_metrics *found) {
    const size_t ticks = (size_t)rate;
    double *heights = calloc(ticks, sizeof *heights);
    knurl_grating grating = gratings_make(KNURL_METHOD_AREA, 1.0 / PERIOD_M, 0.0);
    knurl_grating_state state;
    knurl_velocity estimator;
    double carried = start * PERIOD_M;
    memset(&state, 0, sizeof state);
    grating.update_rate_hz = rate;
    grating.resolution = filtered ? 0.0 : quantum;
    if (!heights || (quantum > 0.0 && knurl_velocity_init(KNURL_VELOCITY_FOAW, quantum, rate, &estimator))) {
        free(heights);
        return 0;
    }
    const size_t lead = ticks / 10;
    for (size_t k = 0; k < lead + ticks; k++) {
        const double x = PERIOD_M * (start + frequency * (double)k / rate);
        const double told[3] = {quantum > 0.0 ? floor(x / quantum + 0.5) * quantum : x, 0.0, 0.0};
        double velocity[3] = {PERIOD_M * frequency, 0.0, 0.0};
        if (quantum > 0.0) {
            knurl_velocity_update(&estimator, told, velocity);
        }
        carried += velocity[0] / rate;
        carried += DRAW * 1000.0 / rate * (told[0] - carried);
        const double place[2] = {filtered ? carried : told[0], 0.0};
        knurl_grating_output out;
        knurl_grating_step(&grating, &state, place, velocity, &out);
        heights[k >= lead ? k - lead : 0] = out.height;
    }
    const int measured = steady_measure(heights, ticks, rate, frequency, found);
    free(heights);
    return measured;
}

int area_positions(json_writer *json) {
    static const double rates[] = {1000.0, 2000.0, 5000.0, 10000.0};
    static const double quanta[] = {0.055e-3, 0.01e-3, 0.0};
    printf("| encoder | rate | spurious, raw (filtered) | push over 50 ms | unevenness |\n|---|---|---|---|---|\n");
    json_open(json, "positions", '[');
    for (int i = 0; i < 12; i++) {
        const double quantum = quanta[i / 4];
        steady_metrics mean[2] = {{0.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 0.0}};
        for (int n = 0; n < 2 * FREQUENCIES * STARTS; n++) {
            const int at = n / 2 / STARTS;
            const int begin = n / 2 % STARTS;
            const double frequency = 20.0 * pow(450.0 / 20.0, (double)at / (FREQUENCIES - 1));
            steady_metrics found;
            if (!scan(rates[i % 4], quantum, n % 2, frequency, (double)begin / STARTS + 0.013, &found)) {
                return 1;
            }
            mean[n % 2].spurious += found.spurious / (FREQUENCIES * STARTS);
            mean[n % 2].push += found.push / (FREQUENCIES * STARTS);
            mean[n % 2].unevenness += found.unevenness / (FREQUENCIES * STARTS);
        }
        printf("| %g mm | %g Hz | %.4f (%.4f) | %.4f (%.4f) | %.4f (%.4f) |\n", 1e3 * quantum, rates[i % 4],
               mean[0].spurious, mean[1].spurious, mean[0].push, mean[1].push, mean[0].unevenness, mean[1].unevenness);
        json_open(json, NULL, '{');
        json_number(json, "quantum", quantum);
        json_number(json, "rate_hz", rates[i % 4]);
        json_number(json, "spurious", mean[0].spurious);
        json_number(json, "spurious_filtered", mean[1].spurious);
        json_number(json, "push", mean[0].push);
        json_number(json, "push_filtered", mean[1].push);
        json_close(json, '}');
    }
    json_close(json, ']');
    return 0;
}

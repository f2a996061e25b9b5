/* Study `even`: how evenly ridges are felt with the gains of a device's model, as they are played.
 * SPDX-License-Identifier: MIT */
#include "even.h"

#include "contender.h"
#include "say.h"
#include "steady.h"
#include "study.h"

#include <math.h>

#define RATE  1000.0
#define TICKS 2000
#define FROM  20.0 /* Hz: of the first gain */

double even_felt(double hz) {
    static double heights[TICKS];
    study_contender c = {.update_rate_hz = RATE, .velocity = STUDY_IDEAL, .ridge = 1e-3};
    study_rendering r;
    steady_metrics found;
    for (const study_method *m = study_methods; m->name; m++) {
        c.method = m->spatial && m->id == KNURL_METHOD_BANDLIMITED ? m : c.method;
    }
    if (study_rendering_start(&r, &c, hz)) {
        return -1.0;
    }
    for (int k = 0; k < TICKS; k++) {
        heights[k] = study_rendering_tick(&r);
    }
    return steady_measure(heights, TICKS, RATE, hz, &found) ? found.felt_level : -1.0;
}

/* The same as knurl_scene_set_gains(). */
static double gain_at(const knurl_gain gains[KNURL_GAINS], double hz) {
    const double at = fmin(fmax(16.0 * log2(hz / FROM), 0.0), KNURL_GAINS - 1.001);
    const int i = (int)at;
    return gains[i].gain + (at - i) * (gains[i + 1].gain - gains[i].gain);
}

static int write_rows(FILE *csv, json_writer *json, void *user) {
    double range[2][2] = {{INFINITY, 0.0}, {INFINITY, 0.0}};
    knurl_gain gains[KNURL_GAINS];
    (void)user;
    if (knurl_gains_from_plant(0.045, 0.5, RATE, gains)) { /* the device and hand of steady_felt_weight() */
        return 1;
    }
    json_string(json, "table", "even.csv");
    fputs("hz,gain,felt_db,felt_even_db\n", csv);
    for (int step = 0; step < 82; step++) { /* 25.3 to 480 Hz */
        const double hz = 25.3 * pow(1.037, step);
        const double felt = even_felt(hz);
        const double levels[2] = {felt, felt * gain_at(gains, hz)};
        for (int i = 0; i < 2 && hz <= 300.0; i++) {
            range[i][0] = fmin(range[i][0], levels[i]);
            range[i][1] = fmax(range[i][1], levels[i]);
        }
        const double cells[] = {gain_at(gains, hz), 20.0 * log10(levels[0]), 20.0 * log10(levels[1])};
        fprintf(csv, "%.15g", hz);
        study_end_row(csv, cells, sizeof cells / sizeof *cells);
    }
    say(stdout, "felt from 25 to 300 Hz: within %.1f dB, with the gains within %.1f dB\n",
        20.0 * log10(range[0][1] / range[0][0]), 20.0 * log10(range[1][1] / range[1][0]));
    for (int i = 0; i < KNURL_GAINS; i++) {
        say(stdout, "{%.1f, %.3f}%s", gains[i].hz, gains[i].gain, i + 1 < KNURL_GAINS ? ", " : "\n");
    }
    return 0;
}

int study_even(const char *folder) {
    return study_write(folder, "even", write_rows, NULL);
}

/* Study `even`: gains of the amplitude over f_t that make ridges equally strong, and the remaining differences.
 * SPDX-License-Identifier: MIT */
#include "even.h"

#include "contender.h"
#include "say.h"
#include "steady.h"
#include "study.h"

#include <math.h>

#define RATE  1000.0
#define TICKS 2000
#define FROM  20.0
#define TO    310.0 /* Hz: the reference is the weakest level up to here; even up to 300 */

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

int even_find(knurl_gain gains[EVEN_GAINS]) {
    double weakest = INFINITY;
    for (int i = 0; i < EVEN_GAINS; i++) {
        gains[i].hz = FROM * exp2(i / 16.0);
        gains[i].gain = even_felt(gains[i].hz);
        if (gains[i].gain < 0.0) {
            return 1;
        }
        weakest = gains[i].hz <= TO ? fmin(weakest, gains[i].gain) : weakest;
    }
    for (int i = 0; i < EVEN_GAINS; i++) {
        gains[i].gain = fmin(1.0, weakest / gains[i].gain);
    }
    return 0;
}

/* The same as knurl_scene_set_gains(). */
static double gain_at(const knurl_gain gains[EVEN_GAINS], double hz) {
    const double at = fmin(fmax(16.0 * log2(hz / FROM), 0.0), EVEN_GAINS - 1.001);
    const int i = (int)at;
    return gains[i].gain + (at - i) * (gains[i + 1].gain - gains[i].gain);
}

static int write_rows(FILE *csv, json_writer *json, void *user) {
    double range[2][2] = {{INFINITY, 0.0}, {INFINITY, 0.0}};
    knurl_gain gains[EVEN_GAINS];
    (void)user;
    if (even_find(gains)) {
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
    for (int i = 0; i < EVEN_GAINS; i++) {
        say(stdout, "{%.1f, %.3f}%s", gains[i].hz, gains[i].gain, i + 1 < EVEN_GAINS ? ", " : "\n");
    }
    return 0;
}

int study_even(const char *folder) {
    return study_write(folder, "even", write_rows, NULL);
}

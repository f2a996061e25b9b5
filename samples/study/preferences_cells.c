/* The published verdicts of the paper's experiments, and this code's metrics. SPDX-License-Identifier: MIT */
#include "preferences.h"

#include "grating_metrics.h"
#include "metrics.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define RATE       1000.0
#define SPEEDS     50 /* 5 to 250 mm/s */
#define SCAN_TICKS 1000
#define TOLERANCE  0.2 /* Weber fraction of Israr and Tan, the stricter of the two charted */
#define PUSH       0.1 /* s */

const char *const preference_metric_names[PREFERENCE_METRICS] = {"net_force_n", "spurious_n", "spurious_share",
                                                                 "dropout_share", "frequency_error"};

/* One method's vibration of 1 N. */
typedef struct vibration {
    double net, spurious_n, spurious_share, dropout, frequency_error;
} vibration;

static int dropout_of(const study_signal *signal, double period_ticks, double *dropout) {
    const size_t ticks = 6000;
    double *values = malloc(ticks * sizeof *values);
    study_scan scan;
    int done = 0;
    for (size_t k = 0; values && k < ticks; k++) {
        values[k] = signal->values[k % signal->length];
    }
    if (values && study_scan_of_values(values, ticks, period_ticks, RATE, &scan)) {
        *dropout = study_scan_dropout(&scan);
        study_scan_free(&scan);
        done = 1;
    }
    free(values);
    return done;
}

static int measure(int32_t method, double period_ticks, vibration *out) {
    const double frequency = RATE / period_ticks;
    knurl_wave wave;
    study_signal signal;
    study_signal whole;
    study_line line;
    if (knurl_wave_prepare(method, period_ticks / RATE, 1.0, RATE, &wave) ||
        !study_signal_of_wave(&wave, RATE, &signal)) {
        return 0;
    }
    /* a number of actual periods with a whole number of requested cycles: twice the period is whole in every cell */
    const size_t times = (size_t)(2.0 * period_ticks);
    double *values = malloc(times * signal.length * sizeof *values);
    for (size_t k = 0; values && k < times * signal.length; k++) {
        values[k] = signal.values[k % signal.length];
    }
    int done = values && study_signal_of_values(values, times * signal.length, RATE, &whole);
    free(values);
    if (done) {
        const double net = study_net(&signal);
        const double rms = study_rms(&signal);
        out->net = fabs(net);
        out->spurious_share = study_spurious(&whole, frequency);
        out->spurious_n = sqrt(out->spurious_share * (rms * rms - net * net));
        done = study_dominant(&signal, &line) && dropout_of(&signal, period_ticks, &out->dropout);
        out->frequency_error = fabs(line.frequency / frequency - 1.0);
        study_signal_free(&whole);
    }
    study_signal_free(&signal);
    return done;
}

/* The results in the text of section IV (figure 8 itself is a picture). */
static int is_preferred(int experiment, double period_ticks, int high, int sound) {
    if (experiment == 2) { /* all with sound; 43.5-143 Hz without, at both intensities */
        return sound || period_ticks >= 7.0;
    }
    if (high) { /* 111-400 Hz, with and without sound */
        return period_ticks <= 9.0;
    }
    return period_ticks <= (sound ? 5.0 : 3.0); /* 200-400 Hz with, 333-400 Hz without */
}

int preference_cells(int experiment, preference_cell cells[PREFERENCE_CELLS]) {
    static const double amplitudes[2][2] = {{1.05, 2.10}, {0.35, 0.70}};
    for (int p = 0; p < PREFERENCE_PERIODS; p++) {
        const double period = p == 0 ? 2.5 : 2.0 * p + 1.0;
        vibration other;
        vibration t3;
        if (!measure(experiment == 1 ? KNURL_WAVE_T1 : KNURL_WAVE_T2, period, &other) ||
            !measure(KNURL_WAVE_T3, period, &t3)) {
            return 0;
        }
        for (int i = 0; i < 4; i++) {
            const int high = i / 2;
            const double amplitude = amplitudes[experiment - 1][high];
            const preference_cell cell = {period,
                                          amplitude,
                                          i % 2,
                                          is_preferred(experiment, period, high, i % 2),
                                          {amplitude * (other.net - t3.net),
                                           amplitude * (other.spurious_n - t3.spurious_n),
                                           other.spurious_share - t3.spurious_share, other.dropout - t3.dropout,
                                           other.frequency_error - t3.frequency_error}};
            cells[4 * p + i] = cell;
        }
    }
    return 1;
}

/* Adds one method at one speed to the means. */
static int add_scan(preference_grating *g, int method, double speed, study_motion *motion) {
    static const double start[2] = {0.000137, 0.0};
    const double velocity[2] = {speed, 0.0};
    const double frequency = speed / (1e-3 * g->period_mm);
    knurl_grating grating;
    study_scan scan;
    memset(&grating, 0, sizeof grating);
    grating.spatial_frequency[0] = 1000.0 / g->period_mm;
    grating.amplitude = 1.0;
    grating.update_rate_hz = RATE;
    grating.method = method == 0 ? KNURL_METHOD_S1 : KNURL_METHOD_S2;
    study_motion_line(start, velocity, RATE, motion, SCAN_TICKS);
    if (!study_scan_run(&grating, motion, SCAN_TICKS, STUDY_CROSSED_PATH, &scan)) {
        return 0;
    }
    g->push[method] += study_scan_push(&scan, frequency, PUSH) / SPEEDS;
    /* the window's width is 2 Hz: at 2.5 Hz (5 mm/s over 2 mm) that is wider than the tolerance */
    g->spurious[method] += study_scan_spurious(&scan, frequency, fmax(TOLERANCE, 2.5 / frequency)) / SPEEDS;
    g->dropout[method] += study_scan_dropout(&scan) / SPEEDS;
    g->drift[method] += (method == 0 ? 0.0 : fabs(study_scan_drift(&scan))) / SPEEDS;
    study_scan_free(&scan);
    return 1;
}

int preference_gratings(preference_grating gratings[3]) {
    static const double periods_mm[3] = {0.5, 1.0, 2.0};
    static const double preferred[3] = {12.0, 11.0, 7.0};
    static study_motion motion[SCAN_TICKS];
    memset(gratings, 0, 3 * sizeof *gratings);
    for (int i = 0; i < 3; i++) {
        gratings[i].period_mm = periods_mm[i];
        gratings[i].preferred_s2 = preferred[i];
        for (int v = 1; v <= SPEEDS; v++) {
            if (!add_scan(&gratings[i], 0, 0.005 * v, motion) || !add_scan(&gratings[i], 1, 0.005 * v, motion)) {
                return 0;
            }
        }
    }
    return 1;
}

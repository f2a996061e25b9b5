/* Accuracy over steady speeds and in strokes. SPDX-License-Identifier: MIT */
#include "accuracy.h"

#include "grating_metrics.h"
#include "steady.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PI         3.141592653589793
#define SPREAD     26
#define EXPERIMENT 12
#define LEAD_S     0.2 /* to fill estimators' windows */
#define FIRST_S    4.0 /* S2's first event may start at a low speed: it has ended by then */
#define STEADY_S   2.0
#define STROKES_S  4.0
#define STROKES_HZ 250.0

double accuracy_frequency(size_t i) {
    if (i < SPREAD) {
        return 20.3 * pow(439.7 / 20.3, (double)i / (SPREAD - 1));
    }
    if (i < SPREAD + EXPERIMENT) {
        return i == SPREAD ? 400.0 : 1000.0 / (2.0 * (double)(i - SPREAD) + 1.0);
    }
    return 421.3 + 2.0 * (double)(i - SPREAD - EXPERIMENT);
}

/* The range of felt levels over all speeds. */
typedef struct range {
    double least, most;
} range;

static void add(const steady_metrics *m, double frequency, double drift, accuracy *a, range *felt) {
    if (frequency > 25.0 && frequency < 470.0) {
        felt->least = fmin(felt->least, m->felt_level);
        felt->most = fmax(felt->most, m->felt_level);
    }
    a->crest = fmax(a->crest, m->crest);
    if (frequency > ACCURACY_SPLIT) {
        a->false_above = fmax(a->false_above, m->false_tones);
        a->felt_above = fmax(a->felt_above, m->felt_false);
        a->wavering_above = fmax(a->wavering_above, m->wavering);
        return;
    }
    const double off = fabs(m->dominant / frequency - 1.0);
    a->mean += m->mean;
    a->mean_worst = fmax(a->mean_worst, m->mean);
    a->push_worst = fmax(a->push_worst, m->push);
    a->frequency += off;
    a->frequency_worst = fmax(a->frequency_worst, off);
    a->false_tones += m->false_tones;
    a->false_worst = fmax(a->false_worst, m->false_tones);
    a->felt += m->felt_false;
    a->felt_worst = fmax(a->felt_worst, m->felt_false);
    a->stylus_worst = fmax(a->stylus_worst, m->felt_stylus);
    a->wavering += m->wavering;
    a->wavering_worst = fmax(a->wavering_worst, m->wavering);
    a->wavering_50_worst = fmax(a->wavering_50_worst, m->wavering_50);
    a->level += fabs(m->level * PI / 4.0 - 1.0);
    a->drift += drift;
}

static int measure_steady(const study_contender *c, double frequency, double *heights, accuracy *a, range *felt) {
    const size_t ticks = (size_t)(STEADY_S * c->update_rate_hz);
    study_rendering r;
    steady_metrics m;
    if (study_rendering_start(&r, c, frequency)) {
        return 0;
    }
    const size_t lead = (size_t)(LEAD_S * c->update_rate_hz);
    const size_t first = (size_t)(FIRST_S * c->update_rate_hz);
    for (size_t k = 0; k < lead || (r.state.playing && k < first); k++) {
        (void)study_rendering_tick(&r);
    }
    r.cycles_played = 0.0;
    for (size_t k = 0; k < ticks; k++) {
        heights[k] = study_rendering_tick(&r);
    }
    const double drift = c->method->spatial ? fabs(r.cycles_played / (frequency * STEADY_S) - 1.0) : NAN;
    if (!steady_measure(heights, ticks, c->update_rate_hz, frequency, &m)) {
        return 0;
    }
    add(&m, frequency, drift, a, felt);
    return 1;
}

/* v = vmax |sin(pi t)|, always forwards, so that errors add up. */
static void play_strokes(const study_contender *c, study_rendering *r, study_scan *scan, double *phase) {
    for (size_t k = 0; k < scan->ticks; k++) {
        const double t = (double)k / c->update_rate_hz;
        const double into = t - floor(t);
        const double x = r->speed / PI * (2.0 * floor(t) + 1.0 - cos(PI * into));
        scan->height[k] = study_rendering_tick_at(r, x, r->speed * sin(PI * into));
        scan->within[k] = r->within;
        scan->cycles[k] = r->within < 0.0 ? 0.0 : study_event_cycles(&r->state.event);
        phase[k] = x / c->ridge + 0.25;
    }
}

static int measure_strokes(const study_contender *c, accuracy *a) {
    const size_t ticks = (size_t)(STROKES_S * c->update_rate_hz);
    study_rendering r;
    double *values = calloc(4 * ticks, sizeof *values);
    study_scan scan = {.ticks = ticks, .update_rate_hz = c->update_rate_hz};
    if (!values || study_rendering_start(&r, c, STROKES_HZ)) {
        free(values);
        return 0;
    }
    scan.height = values;
    scan.within = values + ticks;
    scan.cycles = values + 2 * ticks;
    play_strokes(c, &r, &scan, values + 3 * ticks);
    a->strokes = fabs(r.cycles_played / (STROKES_HZ / PI * 2.0 * STROKES_S) - 1.0);
    a->step = study_scan_step(&scan, values + 3 * ticks).error;
    free(values);
    return 1;
}

int accuracy_measure(const study_contender *c, accuracy *a) {
    double *const means[] = {&a->mean, &a->frequency, &a->false_tones, &a->felt, &a->wavering, &a->level, &a->drift};
    double *heights = malloc((size_t)(STEADY_S * c->update_rate_hz) * sizeof *heights);
    range felt = {INFINITY, 0.0};
    double count = 0.0;
    int done = heights != NULL;
    memset(a, 0, sizeof *a);
    a->strokes = NAN;
    a->step = NAN;
    for (size_t i = 0; done && i < ACCURACY_FREQUENCIES; i++) {
        count += accuracy_frequency(i) <= ACCURACY_SPLIT ? 1.0 : 0.0;
        done = measure_steady(c, accuracy_frequency(i), heights, a, &felt);
    }
    free(heights);
    for (size_t i = 0; i < sizeof means / sizeof *means; i++) {
        *means[i] /= count;
    }
    a->felt_range = 20.0 * log10(felt.most / felt.least);
    return done && (!c->method->spatial || measure_strokes(c, a));
}

/* The fundamental, false tones and net force of steady scans over every whole frequency and ten start phases.
 * SPDX-License-Identifier: MIT */
#include "area_parts.h"

#include "gratings.h"
#include "steady.h"

#include <math.h>
#include <stdio.h>

#define FS          1000.0
#define FIRST_HZ    20
#define LAST_HZ     450
#define STARTS      10
#define FIRST_START 0.013 /* cycles */
#define SPACING     0.09  /* cycles: with 0.1 all starts of a cycle of 10 ticks would give the same samples */
#define IDEAL       1.2732395447351628 /* 4/pi: a square wave's */

typedef struct levels {
    double mean_off, mean_hz;     /* the most that the mean of all phases is off 4/pi, as a share, and where */
    double single_off, single_hz; /* the same of a single phase */
    double spurious, spurious_worst;
    double unevenness, unevenness_worst;
    double push, push_worst; /* A, over 50 ms */
    double net;              /* A: the largest mean of a second */
    double played_off;       /* the most that cycles played over cycles crossed are off 1 */
} levels;

static void take_off(double level, double frequency, double *off, double *hz) {
    if (fabs(level / IDEAL - 1.0) > *off) {
        *off = fabs(level / IDEAL - 1.0);
        *hz = frequency;
    }
}

/* Two seconds from one start, the second one measured. 0: no memory. */
static int measure_start(const knurl_grating *grating, double frequency, double start, levels *l, double line[2]) {
    const size_t ticks = (size_t)grating->update_rate_hz;
    const double velocity[2] = {frequency / FS, 0.0};
    const double from[2] = {start / FS, 0.0};
    steady_metrics one;
    study_scan scan;
    double own[2];
    double net = 0.0;
    if (!gratings_scan_line(grating, from, velocity, 2 * ticks, &scan)) {
        return 0;
    }
    const double *heights = scan.height + ticks;
    const double crossed = scan.crossed[2 * ticks] - scan.crossed[ticks];
    const double off = fabs(scan.played[2 * ticks] - scan.played[ticks] - crossed) - 0.5; /* ends may split a cycle */
    l->played_off = fmax(l->played_off, off / crossed);
    for (size_t k = 0; k < ticks; k++) {
        net += heights[k] / (double)ticks;
    }
    steady_line(heights, ticks, grating->update_rate_hz, frequency, own);
    const int done = steady_measure(heights, ticks, grating->update_rate_hz, frequency, &one);
    study_scan_free(&scan);
    const double angle = 6.283185307179586 * start; /* all phases on one: turned back by where they began */
    line[0] += (own[0] * cos(angle) - own[1] * sin(angle)) / STARTS;
    line[1] += (own[0] * sin(angle) + own[1] * cos(angle)) / STARTS;
    take_off(one.level, frequency, &l->single_off, &l->single_hz);
    const double count = STARTS * (LAST_HZ - FIRST_HZ + 1.0);
    l->net = fmax(l->net, fabs(net));
    l->spurious += one.spurious / count;
    l->spurious_worst = fmax(l->spurious_worst, one.spurious);
    l->unevenness += one.unevenness / count;
    l->unevenness_worst = fmax(l->unevenness_worst, one.unevenness);
    l->push += one.push / count;
    l->push_worst = fmax(l->push_worst, one.push);
    return done;
}

static int measure(int32_t method, double rate, levels *l) {
    knurl_grating grating = gratings_make(method, FS, 0.0);
    grating.update_rate_hz = rate;
    *l = (levels){0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
    for (int hz = FIRST_HZ; hz <= LAST_HZ; hz++) {
        double line[2] = {0.0, 0.0};
        for (int i = 0; i < STARTS; i++) {
            if (!measure_start(&grating, hz, FIRST_START + SPACING * i, l, line)) {
                return 0;
            }
        }
        take_off(hypot(line[0], line[1]), hz, &l->mean_off, &l->mean_hz);
    }
    return 1;
}

static void write_levels(json_writer *json, int32_t method, double rate, const levels *l) {
    printf(
        "| %s, %g kHz | %.3f | %.2f %% (%g Hz) | %.1f %% (%g Hz) | %.4f (%.3f) | %.3f (%.3f) | %.4f (%.3f) | %.1e |\n",
        knurl_method_name(method), 1e-3 * rate, 1.0 + l->played_off, 100.0 * l->mean_off, l->mean_hz,
        100.0 * l->single_off, l->single_hz, l->spurious, l->spurious_worst, l->unevenness, l->unevenness_worst,
        l->push, l->push_worst, l->net);
    json_open(json, NULL, '{');
    json_string(json, "method", knurl_method_name(method));
    json_number(json, "rate_hz", rate);
    json_number(json, "played_off", l->played_off);
    json_number(json, "level_off_mean", l->mean_off);
    json_number(json, "level_off_single", l->single_off);
    json_number(json, "spurious", l->spurious);
    json_number(json, "spurious_worst", l->spurious_worst);
    json_number(json, "unevenness", l->unevenness);
    json_number(json, "unevenness_worst", l->unevenness_worst);
    json_number(json, "push", l->push);
    json_number(json, "push_worst", l->push_worst);
    json_number(json, "net", l->net);
    json_close(json, '}');
}

int area_levels(json_writer *json) {
    static const struct {
        int32_t method;
        double rate;
    } rows[] = {{KNURL_METHOD_S1, 1000.0},   {KNURL_METHOD_S2, 1000.0},   {KNURL_METHOD_LOCKED, 1000.0}, {KNURL_METHOD_AREA, 1000.0},
                {KNURL_METHOD_AREA, 2000.0}, {KNURL_METHOD_AREA, 5000.0}, {KNURL_METHOD_AREA, 10000.0}};
    printf("| 20 to 450 Hz, every whole frequency, 10 start phases | played/crossed, worst | level off 4/pi: mean of "
           "phases, worst (at) | single phase, worst (at) | false tones, mean (worst) | wavering, mean (worst) | push "
           "over 50 ms, mean (worst), A | net of a second, worst, A |\n|---|---|---|---|---|---|---|---|\n");
    json_open(json, "levels", '[');
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        levels l;
        if (!measure(rows[i].method, rows[i].rate, &l)) {
            return 1;
        }
        write_levels(json, rows[i].method, rows[i].rate, &l);
    }
    json_close(json, ']');
    return 0;
}

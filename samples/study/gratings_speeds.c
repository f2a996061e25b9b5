/* One-dimensional gratings over speed, in strokes, and over penetration depth. SPDX-License-Identifier: MIT */
#include "gratings.h"
#include "study.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define LINE_FS      1000.0 /* cycles/m: 1 mm */
#define SPEEDS       1100   /* to 2.2 f_h */
#define DRIFTS       961    /* 20 to 500 Hz */
#define STROKE_TICKS 2600
#define DEPTHS       113 /* 0 to 2.24 A */

static const double start[2] = {0.000137, 0.0};

/* 1 s straight across at temporal frequency f_t. 0: out of memory. */
static int across(int32_t method, double f_t, size_t ticks, study_scan *scan) {
    const knurl_grating grating = gratings_make(method, LINE_FS, 0.0);
    const double velocity[2] = {f_t / LINE_FS, 0.0};
    return gratings_scan_line(&grating, start, velocity, ticks, scan);
}

/* Over `count` frequencies: f_t, dropout, drift. */
static int sweep(int32_t method, double first, double step, size_t count, double (*rows)[3]) {
    for (size_t i = 0; i < count; i++) {
        study_scan scan;
        rows[i][0] = first + step * (double)i;
        if (!across(method, rows[i][0], 2000, &scan)) {
            return 0;
        }
        rows[i][1] = study_scan_dropout(&scan);
        rows[i][2] = study_scan_drift(&scan);
        study_scan_free(&scan);
    }
    return 1;
}

/* The drift at a period, from an integer number of events. 2, which is no possible drift: out of memory */
static double drift_at(double period_ticks) {
    study_scan scan;
    if (!across(KNURL_METHOD_S2, GRATINGS_RATE / period_ticks, 12000, &scan)) {
        return 2.0;
    }
    const double drift = study_scan_drift(&scan);
    study_scan_free(&scan);
    return drift;
}

static void write_sweep(json_writer *json, const char *name, double (*rows)[3], size_t count) {
    json_open(json, name, '{');
    json_numbers(json, "ft", &rows[0][0], count, 3);
    json_numbers(json, "dropout", &rows[0][1], count, 3);
    json_numbers(json, "drift", &rows[0][2], count, 3);
    json_close(json, '}');
}

int gratings_speeds(json_writer *json, gratings_summary *summary) {
    static double s1[SPEEDS][3];
    static double s2[DRIFTS][3];
    if (!sweep(KNURL_METHOD_S1, 2.0, 2.0, SPEEDS, s1) || !sweep(KNURL_METHOD_S2, 20.0, 0.5, DRIFTS, s2)) {
        return 0;
    }
    summary->drift_before = drift_at(3.5 * (1.0 - 1e-9));
    summary->drift_at = drift_at(3.5);
    for (size_t i = 0; i < SPEEDS; i++) {
        summary->s1_silent = s1[i][0] == GRATINGS_RATE ? s1[i][1] : summary->s1_silent;
    }
    for (size_t i = 0; i < DRIFTS; i++) {
        summary->drift_worst[0] = fmin(summary->drift_worst[0], s2[i][2]);
        summary->drift_worst[1] = fmax(summary->drift_worst[1], s2[i][2]);
    }
    json_open(json, "speeds", '{');
    json_number(json, "spatial_frequency", LINE_FS);
    write_sweep(json, "s1", s1, SPEEDS);
    write_sweep(json, "s2", s2, DRIFTS);
    json_number(json, "s1_dropout_at_update_rate", summary->s1_silent);
    json_number(json, "s2_drift_below_3_5_ticks", summary->drift_before);
    json_number(json, "s2_drift_at_3_5_ticks", summary->drift_at);
    json_numbers(json, "s2_drift_range", summary->drift_worst, 2, 1);
    json_close(json, '}');
    return summary->drift_before < 2.0 && summary->drift_at < 2.0;
}

/* Forward along x at a speed that changes; positions are the exact sums of the velocities. */
static void move(double (*speed)(double t), study_motion *motion, size_t ticks) {
    double x = start[0];
    for (size_t k = 0; k < ticks; k++) {
        const double v = speed((double)k / GRATINGS_RATE);
        memset(&motion[k], 0, sizeof motion[k]);
        motion[k].position[0] = x;
        motion[k].velocity[0] = v;
        x += v / GRATINGS_RATE;
    }
}

static double from_rest(double t) {
    return fmin(0.25, 0.5 * t);
}

static double twice_a_second(double t) {
    return 0.125 * (1.0 - cos(12.566370614359172 * t));
}

/* From rest on 2 mm: the curves. */
static int freeze(json_writer *json, study_motion *motion, gratings_summary *summary) {
    static const int32_t methods[] = {KNURL_METHOD_S1, KNURL_METHOD_S2};
    move(from_rest, motion, STROKE_TICKS);
    json_open(json, "from_rest", '{');
    json_number(json, "spatial_frequency", 500);
    json_string(json, "motion", "from rest to 250 mm/s in 0.5 s, then steady; every 10th tick");
    for (int i = 0; i < 2; i++) {
        const knurl_grating grating = gratings_make(methods[i], 500.0, 0.0);
        study_scan scan;
        if (!study_scan_run(&grating, motion, STROKE_TICKS, STUDY_CROSSED_PATH, &scan)) {
            return 0;
        }
        json_numbers(json, i == 0 ? "s1_played" : "s2_played", scan.played, STROKE_TICKS / 10, 10);
        if (i == 1) {
            size_t k = 2; /* the first event starts here, at 1 mm/s, and ends after a whole cycle */
            while (k < STROKE_TICKS && scan.played[k] < 1.0 - 1e-9) {
                k++;
            }
            summary->frozen_seconds = (double)(k - 2) / GRATINGS_RATE;
            summary->frozen_cycles = scan.crossed[k];
            json_numbers(json, "crossed", scan.crossed, STROKE_TICKS / 10, 10);
        }
        study_scan_free(&scan);
    }
    json_number(json, "step_s", 10.0 / GRATINGS_RATE);
    json_number(json, "first_event_s", summary->frozen_seconds);
    json_number(json, "crossed_by_then", summary->frozen_cycles);
    json_close(json, '}');
    return 1;
}

int gratings_strokes(json_writer *json, gratings_summary *summary) {
    static study_motion motion[10000];
    static const double periods_mm[] = {0.5, 1.0, 2.0};
    json_open(json, "strokes", '{');
    if (!freeze(json, motion, summary)) {
        return 0;
    }
    move(twice_a_second, motion, 10000);
    json_open(json, "twice_a_second", '[');
    for (int i = 0; i < 6; i++) {
        const knurl_grating grating =
            gratings_make(i % 2 ? KNURL_METHOD_S2 : KNURL_METHOD_S1, 1000.0 / periods_mm[i / 2], 0.0);
        study_scan scan;
        if (!study_scan_run(&grating, motion, 10000, STUDY_CROSSED_PATH, &scan)) {
            return 0;
        }
        json_open(json, NULL, '{');
        json_number(json, "period_mm", periods_mm[i / 2]);
        json_string(json, "method", knurl_method_name(grating.method));
        json_number(json, "drift", study_scan_drift(&scan));
        json_number(json, "phase_error_cycles", study_scan_phase_error(&scan));
        json_number(json, "dropout", study_scan_dropout(&scan));
        json_close(json, '}');
        study_scan_free(&scan);
    }
    json_close(json, ']');
    json_close(json, '}');
    return 1;
}

int gratings_depths(json_writer *json, gratings_summary *summary) {
    static const double periods[] = {4.0, 3.0, 5.0, 2.5};
    double depths[DEPTHS];
    double net[DEPTHS];
    for (size_t i = 0; i < DEPTHS; i++) {
        depths[i] = 0.02 * (double)i;
    }
    json_open(json, "depths", '{');
    json_string(json, "unit", "depth in A; net force in K A beyond the smooth wall");
    json_numbers(json, "depth", depths, DEPTHS, 1);
    json_open(json, "events", '[');
    for (int i = 0; i < 4; i++) {
        study_scan scan;
        double trough = 0.0;
        if (!across(KNURL_METHOD_S2, GRATINGS_RATE / periods[i], 600, &scan)) {
            return 0;
        }
        for (size_t k = 0; k < DEPTHS; k++) {
            net[k] = study_scan_net(&scan, 1.0, depths[k]);
        }
        for (size_t k = 0; k < scan.whole; k++) {
            trough = fmax(trough, -scan.height[k]);
        }
        json_open(json, NULL, '{');
        json_number(json, "period_ticks", periods[i]);
        json_number(json, "depth_needed", trough);
        json_numbers(json, "net", net, DEPTHS, 1);
        json_close(json, '}');
        summary->depth_needed[0] = i == 1 ? trough : summary->depth_needed[0];
        summary->depth_needed[1] = i == 3 ? trough : summary->depth_needed[1];
        study_scan_free(&scan);
    }
    json_close(json, ']');
    json_close(json, '}');
    return 1;
}

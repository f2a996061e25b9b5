/* Scans for the study `locked`. SPDX-License-Identifier: MIT */
#include "locked.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SPECTRUM_TICKS 2000
#define PI             3.141592653589793
#define DIAGONAL       1.7320508075688772 /* a scene's resolution is that of a count's diagonal */

/* Where the HIP truly is at t: m from its start, and m/s. */
static void move(const locked_scan *w, double top, double t, double *way, double *speed) {
    *way = top * t;
    *speed = top;
    if (w->per_second > 0.0) {
        const double angle = PI * w->per_second * t;
        const double strokes = w->turns ? 0.0 : floor(w->per_second * t);
        const double sign = fmod(strokes, 2.0) == 0.0 ? 1.0 : -1.0;
        *way = top / (PI * w->per_second) * (2.0 * strokes + 1.0 - sign * cos(angle));
        *speed = top * sign * sin(angle);
    }
}

/* What the grating is told, and the true phase. 0: FOAW refuses. */
static int prepare(const locked_scan *w, double frequency, study_motion *motion, double *phase, size_t ticks) {
    const double top = frequency * w->period;
    knurl_velocity velocity;
    if (w->quantum > 0.0 && knurl_velocity_init(KNURL_VELOCITY_FOAW, w->quantum, w->rate, &velocity)) {
        return 0;
    }
    for (size_t k = 0; k < ticks; k++) {
        double way;
        double speed;
        move(w, top, (double)k / w->rate, &way, &speed);
        const double x = way + w->start * w->period;
        memset(&motion[k], 0, sizeof motion[k]);
        phase[k] = x / w->period + 0.25;
        motion[k].position[0] = x;
        motion[k].velocity[0] = speed;
        if (w->quantum > 0.0) {
            const double told[3] = {w->quantum * floor(x / w->quantum + 0.5), 0.0, 0.0};
            double estimate[3];
            knurl_velocity_update(&velocity, told, estimate);
            motion[k].position[0] = told[0];
            motion[k].velocity[0] = estimate[0];
        }
    }
    return 1;
}

static double find_unbalanced(const study_scan *scan) {
    double worst = 0.0;
    double sum = 0.0;
    for (size_t k = 0; k < scan->ticks; k++) {
        if (scan->within[k] <= 0.0) { /* an event or none begins: the one before is complete */
            worst = fmax(worst, fabs(sum));
            sum = 0.0;
        }
        sum += scan->within[k] >= 0.0 ? scan->height[k] : 0.0;
    }
    return worst;
}

int locked_scan_run(const locked_scan *w, double frequency, int all, locked_found *found) {
    const double natural = w->per_second > 0.0 ? 2.0 / w->per_second : 1000.0 / frequency;
    const size_t ticks = (size_t)floor((w->seconds > 0.0 ? w->seconds : natural) * w->rate);
    study_motion *motion = calloc(ticks + 1, sizeof *motion);
    double *phase = calloc(ticks + 1, sizeof *phase);
    const knurl_grating grating = {.method = w->method,
                                   .spatial_frequency = {1.0 / w->period, 0.0},
                                   .amplitude = 1.0,
                                   .update_rate_hz = w->rate,
                                   .resolution = DIAGONAL * w->quantum,
                                   .crossover_hz = w->crossover};
    study_scan scan;
    memset(found, 0, sizeof *found);
    const int done = motion && phase && prepare(w, frequency, motion, phase, ticks) &&
                     study_scan_run(&grating, motion, ticks, STUDY_CROSSED_PATH, &scan);
    if (done) {
        found->step = study_scan_step(&scan, phase);
        found->unbalanced = find_unbalanced(&scan);
        if (all) {
            found->push = study_scan_push(&scan, frequency, 0.05);
            found->net = fabs(study_scan_net(&scan, 1.0, 2.0));
            scan.ticks = scan.ticks < SPECTRUM_TICKS ? scan.ticks : SPECTRUM_TICKS;
            found->spurious = study_scan_spurious(&scan, frequency, 0.25);
        }
        study_scan_free(&scan);
    }
    free(motion);
    free(phase);
    return done;
}

int locked_scan_worst(const locked_scan *what, double frequency, int starts, int all, locked_found *found) {
    locked_scan w = *what;
    memset(found, 0, sizeof *found);
    for (int i = 0; i < starts; i++) {
        locked_found one;
        w.start = what->start + (double)i / starts;
        if (!locked_scan_run(&w, frequency, all, &one)) {
            return 0;
        }
        const double off = fabs(one.step.played - one.step.crossed) / one.step.crossed;
        if (!(off < fabs(found->step.played - found->step.crossed) / found->step.crossed)) { /* NaN at first */
            found->step.played = one.step.played;
            found->step.crossed = one.step.crossed;
        }
        found->step.error = fmax(found->step.error, one.step.error);
        found->step.longest = fmax(found->step.longest, one.step.longest);
        found->unbalanced = fmax(found->unbalanced, one.unbalanced);
        found->push = fmax(found->push, one.push);
        found->net = fmax(found->net, one.net);
        found->spurious = fmax(found->spurious, one.spurious);
    }
    return 1;
}

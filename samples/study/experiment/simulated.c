/* A simulated subject, to run the protocol without a person. It answers by a formula, which is no model of people.
 * SPDX-License-Identifier: MIT */
#include "experiment.h"

#include "grating_metrics.h"
#include "metrics.h"

#include <math.h>
#include <string.h>

/* Difference of badness at which it answers right 73 % of the time. Chosen, not fitted to data. */
#define UNCERTAINTY 0.1

#define SCAN_TICKS 1000
#define SPEEDS     20
#define TOLERANCE  0.2 /* Weber fraction of Israr and Tan */
#define PUSH_S     0.1

double exp_badness(int32_t method, double period_ms, double amplitude) {
    knurl_wave wave;
    study_signal signal;
    if (knurl_wave_prepare(method, 1e-3 * period_ms, amplitude, EXP_RATE, &wave) ||
        !study_signal_of_wave(&wave, EXP_RATE, &signal)) {
        return 1.0; /* no whole number of ticks is a whole number of periods: all power is spurious */
    }
    const double spurious = study_spurious(&signal, 1e3 / period_ms);
    const double badness = fabs(study_net(&signal)) + (isnan(spurious) ? 1.0 : spurious);
    study_signal_free(&signal);
    return badness;
}

double exp_progression_badness(int32_t method, double medium_ms, double amplitude) {
    double periods[3];
    double sum = 0.0;
    exp_neighbours(medium_ms, periods);
    for (int i = 0; i < 3; i++) {
        sum += exp_badness(method, periods[i], amplitude);
    }
    return sum / 3.0;
}

/* One steady speed (m/s) for a second. NaN without memory. */
static double scan_badness(const knurl_grating *grating, double speed, double stiffness) {
    static const double start[2] = {0.000137, 0.0};
    static study_motion motion[SCAN_TICKS];
    const double velocity[2] = {speed, 0.0};
    const double f_t = speed * grating->spatial_frequency[0];
    study_scan scan;
    study_motion_line(start, velocity, EXP_RATE, motion, SCAN_TICKS);
    if (!study_scan_run(grating, motion, SCAN_TICKS, STUDY_CROSSED_PATH, &scan)) {
        return NAN;
    }
    const double spurious = study_scan_spurious(&scan, f_t, fmax(TOLERANCE, 2.5 / f_t)); /* 2 Hz: the window's width */
    const double drift = study_scan_drift(&scan);
    const double badness = stiffness * study_scan_push(&scan, f_t, PUSH_S) + (isnan(spurious) ? 1.0 : spurious) +
                           (isnan(drift) ? 1.0 : fmin(1.0, fabs(drift)));
    study_scan_free(&scan);
    return badness;
}

double exp_grating_badness(int32_t method, double period_mm, double amplitude_mm) {
    static struct {
        int32_t method;
        double period, amplitude, badness;
    } known[16]; /* a cache: a session needs the same few values repeatedly */
    static unsigned next;
    knurl_grating grating;
    double sum = 0.0;
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        if (known[i].method == method && known[i].period == period_mm && known[i].amplitude == amplitude_mm) {
            return known[i].badness;
        }
    }
    memset(&grating, 0, sizeof grating);
    grating.method = method;
    grating.spatial_frequency[0] = 1e3 / period_mm;
    grating.amplitude = 1e-3 * amplitude_mm;
    grating.update_rate_hz = EXP_RATE;
    for (int i = 1; i <= SPEEDS; i++) {
        /* spread by the golden section: at round speeds f_t divides f_h, and S1 has no false tones */
        sum += scan_badness(&grating, 0.01 + 0.24 * fmod(0.6180339887498949 * i, 1.0), 700.0);
    }
    known[next].method = method;
    known[next].period = period_mm;
    known[next].amplitude = amplitude_mm;
    known[next].badness = sum / SPEEDS;
    next = (next + 1) % (sizeof known / sizeof *known);
    return sum / SPEEDS;
}

static double badness_of(const exp_design *design, const exp_trial *trial, int side) {
    return exp_has_gratings(design) ? exp_grating_badness(trial->methods[side], trial->period, trial->amplitude)
                                    : exp_progression_badness(trial->methods[side], trial->period, trial->amplitude);
}

int32_t exp_simulated_answer(const exp_design *design, const exp_trial *trial, uint64_t *state) {
    const double u = fmin(fmax(exp_random(state), 1e-12), 1.0 - 1e-12);
    if (trial->block == 0) {
        return exp_is_right(design, trial, 1);
    }
    return badness_of(design, trial, 0) - badness_of(design, trial, 1) + UNCERTAINTY * log(u / (1.0 - u)) > 0.0 ? 1 : 0;
}

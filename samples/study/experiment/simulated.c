/* A simulated subject, to run the protocol without a person. It answers by a formula and says nothing about people.
 * SPDX-License-Identifier: MIT */
#include "experiment.h"

#include "metrics.h"

#include <math.h>

/* How uncertain it is: badness at which it is right 73 % of the time. Chosen, not fitted to anyone. */
#define UNCERTAINTY 0.1

double exp_badness(int32_t method, double period_ms, double amplitude) {
    knurl_wave wave;
    study_signal signal;
    if (knurl_wave_prepare(method, 1e-3 * period_ms, amplitude, EXP_RATE, &wave) ||
        !study_signal_of_wave(&wave, EXP_RATE, &signal)) {
        return 1.0; /* no whole number of ticks is a whole number of periods: nothing of it is true */
    }
    const double spurious = study_spurious(&signal, 1e3 / period_ms);
    const double badness = fabs(study_net(&signal)) + (isnan(spurious) ? 1.0 : spurious);
    study_signal_free(&signal);
    return badness;
}

/* Experiments 1 and 2: the progression's mean. */
static double progression_badness(int32_t method, const exp_trial *trial) {
    double periods[3];
    double sum = 0.0;
    exp_neighbours(trial->period, periods);
    for (int i = 0; i < 3; i++) {
        sum += exp_badness(method, periods[i], trial->amplitude);
    }
    return sum / 3.0;
}

/* Experiment 3, the paper's own reading of it (IV-C6): S1 is T1 and S2 is T3 at the frequencies that speeds up to
 * 250 mm/s make; the mean over speeds. T3 is judged at the period that it plays. */
static double grating_badness(int32_t method, const exp_trial *trial, double stiffness_n_per_mm) {
    double sum = 0.0;
    int count = 0;
    for (int speed = 10; speed <= 250; speed += 10, count++) { /* mm/s */
        double period = 1e3 * trial->period / speed;
        if (method == KNURL_METHOD_S2) {
            period = period < 2.25 ? 2.0 : period <= 2.75 ? 2.5 : floor(period + 0.5);
        }
        sum += exp_badness(method == KNURL_METHOD_S1 ? KNURL_WAVE_T1 : KNURL_WAVE_T3, period,
                           stiffness_n_per_mm * trial->amplitude);
    }
    return sum / count;
}

int32_t exp_simulated_answer(const exp_design *design, const exp_trial *trial, uint64_t *state) {
    double badness[2];
    for (int i = 0; i < 2; i++) {
        badness[i] = design->experiment == 3 ? grating_badness(trial->methods[i], trial, 0.7)
                                             : progression_badness(trial->methods[i], trial);
    }
    const double u = fmin(fmax(exp_random(state), 1e-12), 1.0 - 1e-12);
    return badness[0] - badness[1] + UNCERTAINTY * log(u / (1.0 - u)) > 0.0 ? 1 : 0;
}

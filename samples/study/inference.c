/* Binomial tails and intervals; power of a sign test over subjects. SPDX-License-Identifier: MIT */
#include "inference.h"

#include "statistics.h"

#include <math.h>

#define SUBJECTS_MAX 200

static double log_choose(uint32_t n, uint32_t m) {
    return lgamma(n + 1.0) - lgamma(m + 1.0) - lgamma((double)(n - m) + 1.0);
}

static double binomial_point(uint32_t n, uint32_t m, double p) {
    if (p <= 0.0 || p >= 1.0) {
        return m == (p <= 0.0 ? 0 : n) ? 1.0 : 0.0;
    }
    return exp(log_choose(n, m) + m * log(p) + (double)(n - m) * log1p(-p));
}

double binomial_tail(uint32_t n, uint32_t m, double p) {
    double tail = 0.0;
    for (uint32_t i = n + 1; i-- > m;) { /* the smallest first, if p is below m/n */
        tail += binomial_point(n, i, p);
    }
    return fmin(1.0, tail);
}

/* The p at which P(m or more) is `tail`; it grows with p. */
static double solve(uint32_t n, uint32_t m, double tail) {
    double low = 0.0;
    double high = 1.0;
    for (int i = 0; i < 60; i++) {
        const double middle = 0.5 * (low + high);
        if (binomial_tail(n, m, middle) < tail) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return 0.5 * (low + high);
}

void binomial_interval(uint32_t n, uint32_t m, double confidence, double interval[2]) {
    const double tail = 0.5 * (1.0 - confidence);
    interval[0] = m == 0 ? 0.0 : solve(n, m, tail);
    interval[1] = m == n ? 1.0 : solve(n, m + 1, 1.0 - tail);
}

static double log_beta(double a, double b) {
    return lgamma(a) + lgamma(b) - lgamma(a + b);
}

/* P(m of `repetitions`): a subject's own share is drawn from a beta distribution. */
static double answers(const preference_model *model, uint32_t m) {
    const uint32_t n = model->repetitions;
    if (model->correlation <= 0.0 || model->share <= 0.0 || model->share >= 1.0) {
        return binomial_point(n, m, model->share);
    }
    const double spread = (1.0 - model->correlation) / model->correlation;
    const double a = model->share * spread;
    const double b = (1.0 - model->share) * spread;
    return exp(log_choose(n, m) + log_beta(m + a, (double)(n - m) + b) - log_beta(a, b));
}

void preference_majority(const preference_model *model, double outcome[3]) {
    outcome[0] = outcome[1] = outcome[2] = 0.0;
    for (uint32_t m = 0; m <= model->repetitions; m++) {
        outcome[2 * m > model->repetitions ? 1 : 2 * m < model->repetitions ? 0 : 2] += answers(model, m);
    }
}

/* needed[n]: Eq. 14's two-sided threshold for 0 to `most` subjects. */
static void find_thresholds(double significance, uint32_t most, uint32_t needed[SUBJECTS_MAX + 1]) {
    for (uint32_t n = 0; n <= most; n++) {
        needed[n] = binomial_threshold(BINOMIAL_TWO_SIDED, n, significance);
    }
}

static double power_of(const preference_model *model, uint32_t subjects, const uint32_t *needed) {
    double outcome[3];
    double power = 0.0;
    preference_majority(model, outcome);
    const double decided = outcome[0] + outcome[1];
    for (uint32_t n = 1; n <= subjects && decided > 0.0; n++) { /* subjects with a majority */
        const double chance = binomial_point(subjects, n, fmin(1.0, decided));
        if (needed[n] <= n && chance > 1e-15) {
            power += chance * binomial_tail(n, needed[n], outcome[1] / decided);
        }
    }
    return power;
}

double preference_power(const preference_model *model, uint32_t subjects, double significance) {
    uint32_t needed[SUBJECTS_MAX + 1];
    const uint32_t most = subjects < SUBJECTS_MAX ? subjects : SUBJECTS_MAX;
    find_thresholds(significance, most, needed);
    return power_of(model, most, needed);
}

uint32_t preference_subjects(const preference_model *model, double significance, double power) {
    uint32_t needed[SUBJECTS_MAX + 1];
    uint32_t least = 0;
    find_thresholds(significance, SUBJECTS_MAX, needed);
    for (uint32_t n = 1; n <= SUBJECTS_MAX; n++) {
        const int is_enough = power_of(model, n, needed) >= power;
        least = !is_enough ? 0 : least ? least : n;
        if (least && n >= 2 * least + 20) { /* the power's steps are small by then */
            break;
        }
    }
    return least;
}

/* Intervals and power of the experiments' analysis, against closed forms, published numbers and scipy.
 * SPDX-License-Identifier: MIT */
#include "support/close.h"

#include "inference.h"
#include "statistics.h"

TEST(tails_of_a_fair_coin_are_eq14_s) {
    for (uint32_t n = 1; n <= 60; n++) {
        for (uint32_t m = 0; m <= n; m++) {
            const double fair = binomial_probability(BINOMIAL_ONE_SIDED, n, m); /* by counts of outcomes */
            CHECK_CLOSE(binomial_tail(n, m, 0.5), fair, 1e-11 * fair);
        }
    }
    CHECK_CLOSE(binomial_tail(3, 2, 0.8), 0.896L, 1e-14L); /* 3 x .64 x .2 + .512 */
    CHECK_CLOSE(binomial_tail(5, 0, 0.3), 1.0L, 1e-14L);
    CHECK_SAME(binomial_tail(5, 1, 0.0), 0.0L);
    CHECK_SAME(binomial_tail(5, 5, 1.0), 1.0L);
}

TEST(intervals_are_the_published_ones) {
    static const struct {
        uint32_t n, m;
        double low, high;
    } known[] = {
        {925, 682, 0.7076683, 0.7654066},                 /* R's manual of binom.test, after Conover (1971) */
        {36, 28, 0.6084823508426491, 0.8988494696550872}, /* scipy 1.17.1, binomtest().proportion_ci("exact") */
        {12, 10, 0.5158622513139235, 0.9791374745403382},
        {20, 10, 0.27195784956079133, 0.7280421504392086}};
    double interval[2];
    for (size_t i = 0; i < COUNT_OF(known); i++) {
        binomial_interval(known[i].n, known[i].m, 0.95, interval);
        CHECK_CLOSE(interval[0], known[i].low, i ? 1e-12L : 5e-8L);
        CHECK_CLOSE(interval[1], known[i].high, i ? 1e-12L : 5e-8L);
    }
    for (uint32_t n = 1; n <= 40; n++) { /* all of n: (alpha/2)^(1/n) to 1 */
        binomial_interval(n, n, 0.95, interval);
        CHECK_CLOSE(interval[0], powl(0.025L, 1.0L / n), 1e-12L);
        CHECK_SAME(interval[1], 1.0L);
        binomial_interval(n, 0, 0.95, interval);
        CHECK_SAME(interval[0], 0.0L);
        CHECK_CLOSE(interval[1], 1.0L - powl(0.025L, 1.0L / n), 1e-12L);
    }
    binomial_interval(0, 0, 0.95, interval); /* nothing was seen */
    CHECK_SAME(interval[0], 0.0L);
    CHECK_SAME(interval[1], 1.0L);
}

TEST(one_trial_a_subject_has_the_binomial_s_power) {
    for (double share = 0.1; share < 1.0; share += 0.2) {
        for (double correlation = 0.0; correlation < 1.0; correlation += 0.45) {
            const preference_model model = {share, correlation, 1};
            const uint32_t needed = binomial_threshold(BINOMIAL_TWO_SIDED, 12, 0.05 / 3.0); /* 11 */
            CHECK_CLOSE(preference_power(&model, 12, 0.05 / 3.0), binomial_tail(12, needed, share), 1e-12L);
        }
    }
}

TEST(majorities_and_power_are_scipy_s) {
    static const struct {
        preference_model model;
        uint32_t subjects;
        double outcome[3], power;
    } known[] = {
        /* scipy 1.17.1: betabinom, binom */
        {{0.75, 0.1, 4}, 22, {0.08436612215909092, 0.7224343039772729, 0.19319957386363643}, 0.8198878154172078},
        {{0.75, 0.1, 4}, 21, {0.08436612215909092, 0.7224343039772729, 0.19319957386363643}, 0.791293029311382},
        {{0.6, 0.3, 4}, 40, {0.28071999999999986, 0.5169046153846151, 0.2023753846153846}, 0.1256690985515107},
        {{0.8, 0.1, 4}, 24, {0.054167272727272606, 0.7955490909090909, 0.15028363636363606}, 0.9759809811449592}};
    for (size_t i = 0; i < COUNT_OF(known); i++) {
        double outcome[3];
        preference_majority(&known[i].model, outcome);
        for (int k = 0; k < 3; k++) {
            CHECK_CLOSE(outcome[k], known[i].outcome[k], 1e-12L);
        }
        CHECK_CLOSE(preference_power(&known[i].model, known[i].subjects, 0.05 / 6.0), known[i].power, 1e-11L);
    }
    const preference_model model = {0.75, 0.1, 4};
    assert_int_equal(preference_subjects(&model, 0.05 / 6.0, 0.8), 22); /* 21 have .79 */
    const preference_model none = {0.5, 0.1, 4};
    assert_int_equal(preference_subjects(&none, 0.05 / 6.0, 0.8), 0);
}

TEST(without_a_difference_a_verdict_is_as_rare_as_the_significance) {
    for (double correlation = 0.0; correlation < 0.9; correlation += 0.2) {
        const preference_model model = {0.5, correlation, 4};
        for (uint32_t subjects = 6; subjects <= 60; subjects += 6) {
            assert_true(2.0 * preference_power(&model, subjects, 0.05 / 6.0) <= 0.05 / 6.0); /* either method */
        }
    }
}

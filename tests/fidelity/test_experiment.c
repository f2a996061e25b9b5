/* The paper's experiments (section IV) as samples/study/experiment/ runs them: design, neighbours, order, Eq. 14 and
 * its thresholds. SPDX-License-Identifier: MIT */
#include "support/close.h"

#include "experiment.h"
#include "statistics.h"

#include <stdlib.h>

/* --- Eq. 14 by Pascal's triangle, in integers --- */

#define MOST 60

static uint64_t choose[MOST + 1][MOST + 2];

static void make_triangle(void) {
    for (uint32_t n = 0; n <= MOST; n++) {
        choose[n][0] = 1;
        for (uint32_t m = 1; m <= n; m++) {
            choose[n][m] = choose[n - 1][m - 1] + (m < n ? choose[n - 1][m] : 0);
        }
    }
}

/* How many of the 2^n equally likely outcomes the rule counts. */
static uint64_t outcomes(int32_t rule, uint32_t n, uint32_t m) {
    uint64_t sum = rule == BINOMIAL_POINT ? choose[n][m] : 0;
    for (uint32_t i = m; rule != BINOMIAL_POINT && i <= n; i++) {
        sum += choose[n][i];
    }
    return rule == BINOMIAL_TWO_SIDED ? 2 * sum : sum;
}

TEST(eq14_and_its_tails_are_counts_of_outcomes) {
    make_triangle();
    for (uint32_t n = 1; n <= MOST; n++) {
        for (uint32_t m = 0; m <= n; m++) {
            for (int32_t rule = BINOMIAL_POINT; rule <= BINOMIAL_TWO_SIDED; rule++) {
                const long double exact =
                    fminl(1.0L, ldexpl((long double)outcomes(rule, n, m), -(int)n)); /* twice a half and more is 1 */
                CHECK_CLOSE(binomial_probability(rule, n, m), exact, 1e-13L * exact);
            }
        }
    }
    CHECK_CLOSE(binomial_probability(BINOMIAL_POINT, 2000, 1000), 0.0178390111L, 1e-9L); /* Stirling: no overflow */
}

TEST(thresholds_are_the_paper_s_and_those_of_the_tails) {
    static const struct {
        uint32_t n, family, by_rule[3];
    } known[] = {{36, 48, {28, 28, 29}}, {12, 3, {10, 11, 11}}, {3, 48, {4, 4, 4}}, {1, 3, {2, 2, 2}}};
    make_triangle();
    for (size_t i = 0; i < COUNT_OF(known); i++) {
        for (int32_t rule = BINOMIAL_POINT; rule <= BINOMIAL_TWO_SIDED; rule++) {
            assert_int_equal(binomial_threshold(rule, known[i].n, 0.05 / known[i].family), known[i].by_rule[rule]);
        }
    }
    for (uint32_t n = 1; n <= 50; n++) { /* 0.05/48 = 1/960 and 0.05/3 = 1/60, in integers */
        for (int32_t rule = BINOMIAL_POINT; rule <= BINOMIAL_TWO_SIDED; rule++) {
            for (uint64_t inverse = 60; inverse <= 960; inverse += 900) {
                uint32_t m = n / 2 + 1;
                while (m <= n && outcomes(rule, n, m) * inverse > UINT64_C(1) << n) {
                    m++;
                }
                assert_int_equal(binomial_threshold(rule, n, 1.0 / (double)inverse), m);
            }
        }
    }
}

/* --- the design --- */

TEST(designs_are_section_IV_s) {
    static const double amplitudes[3][2] = {{1.05, 2.10}, {0.35, 0.70}, {0.27, 2.7}};
    for (int32_t e = 1; e <= 3; e++) {
        const exp_design *d = exp_design_of(e);
        CHECK_SAME(d->amplitudes[0], amplitudes[e - 1][0]);
        CHECK_SAME(d->amplitudes[1], amplitudes[e - 1][1]);
        assert_int_equal(d->period_count, e == 3 ? 3 : 12);
        assert_int_equal(d->blocks, e == 3 ? 1 : 3);
        for (uint32_t i = 0; e < 3 && i < 11; i++) {
            CHECK_SAME(d->periods[i], 23.0 - 2.0 * i); /* odd, 43.5 to 333 Hz */
        }
        CHECK_SAME(d->periods[d->period_count - 1], e == 3 ? 2.0 : 2.5);
    }
    assert_null(exp_design_of(0));
    assert_null(exp_design_of(4));
}

/* Figure 3 is 50, 49, ... 3 ms, then 2.5 and 2 ms. */
TEST(neighbours_are_the_next_in_figure_3) {
    double figure[50];
    size_t count = 0;
    for (int ms = 50; ms >= 3; ms--) {
        figure[count++] = ms;
    }
    figure[count++] = 2.5;
    figure[count++] = 2.0;
    const exp_design *d = exp_design_of(1);
    for (uint32_t i = 0; i < d->period_count; i++) {
        double got[3];
        size_t at = 0;
        while (figure[at] != d->periods[i]) {
            at++;
        }
        exp_neighbours(d->periods[i], got);
        for (size_t k = 0; k < 3; k++) {
            CHECK_SAME(got[k], figure[at + k - 1]);
        }
    }
}

/* --- order --- */

static int ours_first(const exp_trial *trial, const exp_design *d) {
    return trial->methods[0] == d->methods[1];
}

/* Each run of twelve: one block, one intensity, every period once, T3 first six times. */
static void check_pairing(const exp_trial *trials, const exp_design *d) {
    int first = 0;
    for (uint32_t p = 0; p < 12; p++) {
        int times = 0;
        for (uint32_t i = 0; i < 12; i++) {
            times += trials[i].period == d->periods[p];
        }
        assert_int_equal(times, 1);
        assert_int_equal(trials[p].block, trials[0].block);
        CHECK_SAME(trials[p].amplitude, trials[0].amplitude);
        assert_int_not_equal(trials[p].methods[0], trials[p].methods[1]);
        first += ours_first(&trials[p], d);
    }
    assert_int_equal(first, 6);
}

TEST(blocks_hold_every_cell_once_in_an_order_that_chance_makes) {
    enum { SEEDS = 400 };
    int high_first = 0;
    int ours_at_400 = 0;
    int at_front[12] = {0};
    for (uint64_t seed = 0; seed < SEEDS; seed++) {
        const exp_design *d = exp_design_of(1 + (int32_t)(seed % 2));
        exp_trial trials[EXP_MAX_TRIALS];
        assert_int_equal(exp_plan(d, seed, 0, 0, trials), 72);
        for (uint32_t i = 0; i < 72; i += 12) {
            check_pairing(trials + i, d);
            assert_int_equal(trials[i].block, 1 + i / 24);
            high_first += i % 24 == 0 && trials[i].amplitude == d->amplitudes[1];
            for (uint32_t k = 0; k < 12; k++) {
                ours_at_400 += trials[i + k].period == 2.5 && ours_first(&trials[i + k], d);
                at_front[k] += trials[i].period == d->periods[k];
            }
            assert_true(i % 24 == 0 || trials[i].amplitude != trials[i - 1].amplitude);
        }
    }
    assert_true(abs(high_first - 600) < 70);   /* of 1200: 4 sigma */
    assert_true(abs(ours_at_400 - 1200) < 98); /* of 2400 */
    for (int k = 0; k < 12; k++) {
        assert_true(abs(at_front[k] - 200) < 55); /* of 2400, one in twelve */
    }
}

TEST(experiment_3_has_each_grating_once_and_either_side) {
    const exp_design *d = exp_design_of(3);
    int left = 0;
    int front[3] = {0};
    for (uint64_t seed = 0; seed < 600; seed++) {
        exp_trial trials[EXP_MAX_TRIALS];
        const int reduced = (int)(seed % 2);
        double sum = 0.0;
        assert_int_equal(exp_plan(d, seed, reduced, 0, trials), 3);
        for (int i = 0; i < 3; i++) {
            CHECK_SAME(trials[i].amplitude, reduced ? 0.27 : 2.7);
            sum += trials[i].period * trials[i].period;
            left += ours_first(&trials[i], d);
            front[i] += trials[0].period == d->periods[i];
        }
        CHECK_SAME(sum, 5.25L); /* 0.5, 1 and 2 */
    }
    assert_true(abs(left - 900) < 85);
    for (int i = 0; i < 3; i++) {
        assert_true(abs(front[i] - 200) < 47);
    }
}

TEST(a_seed_makes_one_order_and_another_seed_another) {
    exp_trial a[EXP_MAX_TRIALS];
    exp_trial b[EXP_MAX_TRIALS];
    (void)exp_plan(exp_design_of(1), 7, 0, 0, a);
    (void)exp_plan(exp_design_of(1), 7, 0, 0, b);
    assert_memory_equal(a, b, sizeof a);
    (void)exp_plan(exp_design_of(1), 8, 0, 0, b);
    assert_memory_not_equal(a, b, sizeof a);
}

/* --- the simulated answerer --- */

TEST(the_simulated_answerer_is_the_formula_it_says) {
    enum { DRAWS = 2000 };
    const exp_trial trial = {1, 5, 1.05, {KNURL_WAVE_T1, KNURL_WAVE_T3}, {0, 0}};
    double periods[3];
    double difference = 0.0;
    uint64_t noise = 1;
    int second = 0;
    CHECK_CLOSE(exp_badness(KNURL_WAVE_T1, 4, 1), 0.0L, 1e-4L);  /* even: neither a net force nor a false line */
    CHECK_CLOSE(exp_badness(KNURL_WAVE_T2, 3, 1), 1.0L, 1e-12L); /* no line at its frequency */
    CHECK_CLOSE(exp_badness(KNURL_WAVE_T1, 3, 2) - exp_badness(KNURL_WAVE_T1, 3, 1), 1.0L / 3.0L, 1e-9L); /* A/N */
    exp_neighbours(trial.period, periods);
    for (int i = 0; i < 3; i++) {
        difference +=
            (exp_badness(KNURL_WAVE_T1, periods[i], 1.05) - exp_badness(KNURL_WAVE_T3, periods[i], 1.05)) / 3.0;
    }
    for (int i = 0; i < DRAWS; i++) {
        second += exp_simulated_answer(exp_design_of(1), &trial, &noise);
    }
    const double p = 1.0 / (1.0 + exp(-difference / 0.1));
    CHECK_CLOSE(second, DRAWS * p, 4.0 * sqrt(DRAWS * p * (1.0 - p)));
}

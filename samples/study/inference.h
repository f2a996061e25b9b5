/* From counts of preferences to conclusions: intervals, and the number of subjects that an experiment needs.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_STUDY_INFERENCE_H
#define KNURL_STUDY_INFERENCE_H

#include <stdint.h>

/** P(m or more of n), each with probability p. */
double binomial_tail(uint32_t n, uint32_t m, double p);

/** The exact (Clopper-Pearson) interval of a share, from m of n observations; confidence such as 0.95. */
void binomial_interval(uint32_t n, uint32_t m, double confidence, double interval[2]);

/** A model of subjects who answer `repetitions` (1 to 100) trials each. */
typedef struct preference_model {
    double share;       /**< 0 to 1: the share of answers for the second method, over all subjects */
    double correlation; /**< 0 to below 1: between two answers of a subject (beta-binomial): 0 if all subjects are
                           alike, near 1 if each has an opinion that never changes */
    uint32_t repetitions;
} preference_model;

/** outcome[0], [1]: the probability that a subject prefers the first or the second method in more than half of the
 * trials; [2]: neither. */
void preference_majority(const preference_model *model, double outcome[3]);

/** The probability that Eq. 14's two-sided tail over the subjects' majorities, without subjects that have none, finds
 * the second method preferred at `significance`. subjects: at most 200. */
double preference_power(const preference_model *model, uint32_t subjects, double significance);

/** The smallest number of subjects from which on the power is never below `power`; 0: more than 200. */
uint32_t preference_subjects(const preference_model *model, double significance, double power);

#endif

/* Statistics of the studies and of the experiments' analysis. The GNU Scientific Library has half of them (neither
 * tau-b nor ties within a tolerance), and the programs would have to take its licence, the GPL.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_STUDY_STATISTICS_H
#define KNURL_STUDY_STATISTICS_H

#include <stddef.h>
#include <stdint.h>

/** The quantile at `share` (0 to below 1) of at least one value; sorts them. 0.5: the median; for an even count the
 * upper one. */
double quantile(double *values, size_t count, double share);

#define RANK_MAX 256 /* values at most */

/** Spearman's rho: Pearson's correlation of the mid-ranks. NaN if either is constant. */
double rank_spearman(const double *x, const double *y, size_t count);

/** Kendall's tau-b: concordant less discordant pairs, over the geometric mean of the pairs not tied in x and not tied
 * in y. NaN if either is constant. */
double rank_kendall(const double *x, const double *y, size_t count);

/** The probability that x of a random pair with y > 0.5 exceeds x of a random other pair, ties counting half (the area
 * under the ROC curve): 1 separates completely, 0.5 not at all. NaN if either group is empty. */
double rank_separation(const double *x, const double *y, size_t count);

enum { BINOMIAL_POINT = 0, BINOMIAL_ONE_SIDED = 1, BINOMIAL_TWO_SIDED = 2 };

/** Under chance (p = 0.5): BINOMIAL_POINT P(m of n), Eq. 14; BINOMIAL_ONE_SIDED P(m or more); BINOMIAL_TWO_SIDED twice
 * that, at most 1. */
double binomial_probability(int32_t rule, uint32_t n, uint32_t m);

/** The least m above n/2 with a probability of at most `significance`; n + 1 if there is none. */
uint32_t binomial_threshold(int32_t rule, uint32_t n, double significance);

#endif

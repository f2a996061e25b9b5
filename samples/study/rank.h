/* Rank correlations, ties handled. SPDX-License-Identifier: MIT */
#ifndef KNURL_STUDY_RANK_H
#define KNURL_STUDY_RANK_H

#include <stddef.h>

#define RANK_MAX 256 /* values at most */

/** Spearman's rho: Pearson's correlation of the mid-ranks. NaN where either does not vary. */
double rank_spearman(const double *x, const double *y, size_t count);

/** Kendall's tau-b: concordant less discordant pairs, over the geometric mean of the pairs not tied in x and not tied
 * in y. NaN where either does not vary. */
double rank_kendall(const double *x, const double *y, size_t count);

/** The chance that x of a pair drawn from y > 0.5 is above x of one drawn from the others, ties by half (the area under
 * the ROC curve): 1 separates completely, 0.5 says nothing. NaN where there is none of either. */
double rank_separation(const double *x, const double *y, size_t count);

#endif

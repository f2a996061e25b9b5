/* The cost of a tick: nanoseconds on this machine, and instructions, which are reproducible.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_STUDY_COST_H
#define KNURL_STUDY_COST_H

#include "contender.h"

typedef struct study_cost {
    double ns_median; /**< per tick, less the empty tick; over batches of 1,000 */
    double ns_p99;
} study_cost;

/** Median times of a tick of `subject` over batches, including the empty tick. */
void study_time_ticks(double (*tick)(void *), void *subject, study_cost *cost);

/** Times a contender. Returns 0 if memory runs out. */
int study_measure_cost(const study_contender *contender, study_cost *cost);

/** The calibrated empty tick: loop, call and motion of a tick without rendering, ns. */
double study_empty_tick_ns(void);

/** Instructions per tick, by valgrind's callgrind: the difference between runs of 20,000 and 10,000 ticks of
 * knurl_tick_row, in the running program's folder. NaN if valgrind is not installed. */
double study_count_instructions(size_t contender_index);

#endif

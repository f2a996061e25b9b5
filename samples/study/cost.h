/* The cost of a tick: nanoseconds on this machine, and instructions, which are reproducible.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_STUDY_COST_H
#define KNURL_STUDY_COST_H

#include "contender.h"

typedef struct study_cost {
    double ns_median; /**< a tick, the empty tick's taken off; over batches of 1,000 */
    double ns_p99;
} study_cost;

/** Medians over batches of what one tick of `subject` takes, the empty tick included. */
void study_time_ticks(double (*tick)(void *), void *subject, study_cost *cost);

/** Times a contender. 0 where memory is not to be had. */
int study_measure_cost(const study_contender *contender, study_cost *cost);

/** The calibrated empty tick: loop, call and motion of a tick that renders nothing, ns. */
double study_empty_tick_ns(void);

/** Instructions a tick, by valgrind's callgrind: the difference of a run of 20,000 and one of 10,000 ticks of
 * knurl_tick_row, which stands beside the running program. NaN where valgrind is not installed. */
double study_count_instructions(size_t contender_index);

#endif

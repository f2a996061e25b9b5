/* A HIP's time, counted by its ticks. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_HIP_CLOCK_H
#define KNURL_SRC_HIP_CLOCK_H

#include "base/atomic.h"
#include "base/finite.h"

/* A HIP's time. It may lag behind that of HIPs that have ticked more often. */
typedef struct knurl_hip_clock {
    double time; /* atomic: s, scene time after the last tick */
    double previous_time;
    double period; /* s */
    uint64_t tick; /* from 1 */
} knurl_hip_clock;

/* Advances by one period. */
static inline void knurl_hip_clock_advance(knurl_hip_clock *clock) {
    const double time = clock->time + clock->period;
    clock->previous_time = clock->time;
    clock->tick++;
    knurl_store_double(&clock->time, time);
}

#endif

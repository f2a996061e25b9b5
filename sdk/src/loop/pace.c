/* Timing of cycles by absolute deadlines. SPDX-License-Identifier: MIT */
#include "loop/loop_internal.h"

void knurl_pace_start(knurl_pace *pace, const knurl_clock *clock, double rate) {
    pace->clock = *clock;
    pace->period_ns = 1e9 / rate;
    pace->start_ns = clock->now_ns(clock->user);
    pace->cycle = 0;
}

int64_t knurl_pace_wait(knurl_pace *pace, int *overrun) {
    pace->cycle++;
    const int64_t deadline = pace->start_ns + (int64_t)((double)pace->cycle * pace->period_ns); /* no drift at 3 kHz */
    pace->clock.sleep_until_ns(deadline, pace->clock.user);
    pace->woke_at = pace->clock.now_ns(pace->clock.user);
    const int64_t late = pace->woke_at - deadline;
    *overrun = (double)late > 0.5 * pace->period_ns;
    if ((double)late > pace->period_ns) {
        pace->cycle += (uint64_t)((double)late / pace->period_ns);
    }
    return late;
}

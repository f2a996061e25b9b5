/* Runs in the laboratory with and without protections, and whether they stop a runaway. SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_PROTECTION_H
#define KNURL_TEST_PROTECTION_H

#include "support/close.h"

#include "lab.h"

#define PASSIVITY_ONLY (KNURL_PROTECT_ALL & ~(uint32_t)KNURL_PROTECT_PASSIVITY)

/* Near the limit a swing takes seconds to grow, and a stroke turns after a metre: judged is the end of five seconds or
 * of 0.98 m. */
static inline void judge_late(lab_case *c) {
    c->seconds = 0.3;
    c->settle = fmin(5.0, 0.98 / fmax(c->speed, 0.1)) - 0.25 - c->seconds;
}

static inline lab_result run(const lab_case *c, lab_signals *into) {
    lab_result r;
    memset(&r, 0, sizeof r);
    if (lab_run(c, into, &r)) {
        fail_msg("%s", knurl_error_message());
    }
    return r;
}

/* From the lowest to the highest over the last quarter of a second. */
static inline double late_swing(const lab_signals *s, const double *values) {
    double low = HUGE_VAL;
    double high = -HUGE_VAL;
    for (size_t i = s->count - 250; i < s->count; i++) {
        low = fmin(low, values[i]);
        high = fmax(high, values[i]);
    }
    return high - low;
}

/* s from the first touch to the first tick in which the controller acts; negative: it never does. */
static inline double time_to_act(const lab_signals *s) {
    size_t touched = 0;
    while (touched < s->count && s->measured[touched] >= 0.0) {
        touched++;
    }
    for (size_t i = touched; i < s->count; i++) {
        if (s->flags[i] & KNURL_TICK_PASSIVITY) {
            return 0.001 * (double)(i - touched);
        }
    }
    return -1.0;
}

/* No longer unstable, and the force's swing is at most a sixth of the raw one. with: the same run, protected. */
static inline int is_stopped(const lab_result *with, const lab_signals *with_signals, const lab_signals *raw_signals) {
    return with->outcome != LAB_UNSTABLE && time_to_act(with_signals) >= 0.0 &&
           late_swing(with_signals, with_signals->written) <= late_swing(raw_signals, raw_signals->written) / 6.0;
}

#endif

/* The frequencies that a method can play, and the steps between them that can be felt (figure 3).
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_STUDY_COVERAGE_H
#define KNURL_STUDY_COVERAGE_H

#include <stddef.h>
#include <stdint.h>

/** Sets of periods, each including the previous one: even; odd; the mixed case, 2.5 ticks. */
enum { STUDY_SET_EVEN = 0, STUDY_SET_ODD = 1, STUDY_SET_MIXED = 2, STUDY_SETS = 3 };

/** STUDY_GAP_NEIGHBOUR is the paper's rule: a gap is a neighbour above f(1 + WF); it reaches from f(1 + WF) to that
 * neighbour. STUDY_GAP_UNREACHED is weaker: every frequency must be within WF of a played one on either side, so a gap
 * reaches from f(1 + WF) to the neighbour / (1 + WF). */
enum { STUDY_GAP_NEIGHBOUR = 0, STUDY_GAP_UNREACHED = 1 };

/** Enough for 20 Hz at 10 kHz. */
#define STUDY_MAX_REACH 600

typedef struct study_reach {
    double frequency; /**< Hz: update rate / ticks */
    double ticks;     /**< a cycle's length; 2.5 for the mixed case */
    int32_t kind;     /**< KNURL_EVENT_EVEN, _ODD or _MIXED */
} study_reach;

typedef struct study_gap {
    double low; /**< Hz */
    double high;
} study_gap;

/** The frequencies that T3 (knurl_vibration_event_prepare()) plays from `lowest_hz` to half the update rate, ascending;
 * those of `set` only. reach: STUDY_MAX_REACH. Returns their number. */
size_t study_reachable(double update_rate_hz, double lowest_hz, int set, study_reach *reach);

/** The gaps between them by `rule`, ascending; a neighbour at f(1 + WF), within rounding (1e-9), is no gap. gaps: room
 * for `count`. Returns their number. */
size_t study_gaps(const study_reach *reach, size_t count, double weber, int rule, study_gap *gaps);

/** The highest frequency up to which there is no gap by the paper's rule. count: at least 1. */
double study_no_gap_up_to(const study_reach *reach, size_t count, double weber);

#endif

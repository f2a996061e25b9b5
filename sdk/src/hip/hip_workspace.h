/* A workspace that is moved and zoomed while its HIP ticks. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_HIP_WORKSPACE_H
#define KNURL_SRC_HIP_WORKSPACE_H

#include "base/base.h"
#include "base/seqlock.h"
#include "surface/pose.h"

#include <knurl/motion.h>

/* A change of scale, from `start` to `end`, at a constant rate of its logarithm. */
typedef struct knurl_zoom {
    double start, end;
    double start_time, end_time; /* s, scene time */
} knurl_zoom;

typedef struct knurl_workspace_motion {
    knurl_motion frame;
    knurl_zoom zoom;
} knurl_workspace_motion;

typedef struct knurl_workspace_move {
    uint64_t sequence;             /* atomic: of `given` */
    uint64_t seen;                 /* haptic thread: the sequence at which `motion` was copied */
    int32_t is_on;                 /* haptic thread: 1 until the motion is over */
    knurl_workspace_motion motion; /* haptic thread: its copy of `given` */
    uint64_t given[sizeof(knurl_workspace_motion) / sizeof(uint64_t)]; /* atomic */
    knurl_workspace_motion latest; /* the same, for threads that hold the scene's lock */
} knurl_workspace_move;

/* 1 if the workspace moves in this tick, or was moved since the last one. */
static inline int knurl_workspace_is_moving(const knurl_workspace_move *move) {
    return KNURL_UNLIKELY(move->is_on || knurl_load_acquire(&move->sequence) != move->seen);
}

/* Moves the workspace to its pose at `time` (s). Returns 1 if it jumped there since the last tick. [haptic thread] */
int knurl_workspace_advance(knurl_workspace_move *move, double time, knurl_workspace *workspace,
                            int32_t *is_rotated) KNURL_NONBLOCKING;

/* Moves it from its pose at `now` (s) to `target` in `seconds`. start: its pose before the first move. [any thread,
 * under the scene's lock] */
void knurl_workspace_go(knurl_workspace_move *move, const knurl_workspace *start, const knurl_workspace *target,
                        double now, double seconds);

/* The pose at the end of all moves so far. start: as above. [any thread, under the scene's lock] */
void knurl_workspace_target(const knurl_workspace_move *move, const knurl_workspace *start, knurl_workspace *target);

#endif

/* The passivity controller: detects walls that oscillate by themselves, and softens them.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_PASSIVITY_H
#define KNURL_SRC_PASSIVITY_H

#include "base/base.h"
#include "guard/hip_facts.h"
#include "guard/wall.h"

#define KNURL_PASSIVITY_REVERSAL 0.2e-3 /* m that the depth must come back by to count as a reversal: four quanta */

/* A HIP's swings in walls that could be unstable. Scene units. */
typedef struct knurl_passivity {
    double safe;        /* N/m: stiffness up to which a wall is stable and not watched; infinite: protection off */
    double unit;        /* m, scene: a device's metre */
    double depth;       /* m: of the deepest wall in this tick, after the entry ramp; 0 outside */
    double extreme;     /* m: depth at the last reversal */
    double farthest;    /* m: farthest depth since, in the present direction */
    double direction;   /* 1: heading out, -1: in */
    double largest;     /* m: largest swing of the row, decaying */
    double squares;     /* m^2: of the row's swings */
    double moved;       /* m: total change of H since the last reversal */
    double reversal;    /* m: KNURL_PASSIVITY_REVERSAL, scene */
    uint32_t crossings; /* zero crossings of H since the last reversal */
    uint32_t crossed;   /* and in the half swing before */
    int32_t row;        /* swings in the row, each as large as those before it */
    int32_t longest;    /* ticks: a longer swing in and out may be a hand's motion */
    int32_t ticks;      /* since the last reversal, at most one more than `longest` */
    int32_t before;     /* and in the half swing before */
    int32_t busy;       /* 1: there is a depth to follow, or an alarm */
    int32_t alarmed;
    double soft;      /* 0 to 1: progress towards the passive stiffness */
    double softening; /* of the remaining change, per tick */
    double off;       /* ticks since the HIP was last in a wall */
    double off_most;  /* ticks outside until the alarm ends */
} knurl_passivity;

void knurl_passivity_init(knurl_passivity *passivity, const knurl_hip_facts *facts);

/* Sets the values that depend on the workspace's scale: scene metres a device metre. watches: 0: protection off. */
void knurl_passivity_set_scale(knurl_passivity *passivity, int watches, const knurl_hip_facts *facts,
                               double scale) KNURL_NONBLOCKING;

/* Slow paths of knurl_passivity_follow(). */
void knurl_passivity_go_on(knurl_passivity *passivity) KNURL_NONBLOCKING;
void knurl_passivity_end_swing(knurl_passivity *passivity) KNURL_NONBLOCKING;

static inline void knurl_passivity_end_row(knurl_passivity *p) {
    p->largest = p->squares = 0.0;
    p->row = 0;
}

/* Advances by one tick. Only needed while `busy`. */
static inline void knurl_passivity_follow(knurl_passivity *p) {
    const double behind = p->direction * (p->depth - p->farthest);
    if (KNURL_UNLIKELY(p->alarmed)) {
        knurl_passivity_go_on(p);
        p->depth = 0.0;
        return;
    }
    const int is_long = p->ticks > p->longest; /* it ends the row, whatever follows */
    if (!is_long) {
        p->ticks++;
    }
    if (KNURL_UNLIKELY(behind > p->reversal)) {
        knurl_passivity_end_swing(p);
    } else if (behind < 0.0) {
        p->farthest = p->depth;
    } else if (is_long && !(p->depth > 0.0)) {
        p->busy = 0;
    }
    p->depth = 0.0;
}

/* 1 if the texture matters: not in a swing that is too long already, as at rest. */
static inline int knurl_passivity_counts(const knurl_passivity *p) {
    return p->busy && p->ticks <= p->longest;
}

/* Slow path of knurl_passivity_watch(): softens a wall that the HIP is in during an alarm. */
void knurl_passivity_soften(knurl_passivity *passivity, knurl_wall *wall) KNURL_NONBLOCKING;

/* Follows the depth in a wall that could be unstable; during an alarm, softens it. */
static inline void knurl_passivity_watch(knurl_passivity *p, knurl_wall *wall, uint32_t *flags) {
    const double depth = -wall->z;
    p->depth = depth > p->depth ? depth : p->depth;
    p->busy = 1;
    if (KNURL_UNLIKELY(p->alarmed) && depth > 0.0) {
        knurl_wall softened = *wall; /* a copy, so that `wall` itself can stay in registers */
        knurl_passivity_soften(p, &softened);
        *wall = softened;
        *flags |= KNURL_TICK_PASSIVITY;
    }
}

#endif

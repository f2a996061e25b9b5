/* The contents of a knurl_velocity. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_VELOCITY_H
#define KNURL_SRC_VELOCITY_H

#include <knurl/motion.h>

/* FOAW's widest window in samples, 15 ms at 1 kHz, a common choice; and the most ticks between its samples. */
#define KNURL_FOAW_WINDOW     15
#define KNURL_FOAW_STRIDE_MAX 10

typedef struct knurl_velocity_state {
    double history[KNURL_FOAW_STRIDE_MAX][32][4]; /* FOAW: a ring of 16 rows per tick of the stride; rows as in `held`,
                                                     the newest in row `newest`, older ones after it. Each row is stored
                                                     twice, so that a window never wraps */
    double held[4];     /* FOAW: the newest position after the backlash, in whole 1024ths of a quantum: x, y, z, 0 */
    double last[3];     /* DIFFERENCE: the previous position, m */
    double rate;        /* update rate, Hz */
    double steps_per_m; /* FOAW: fixed-point steps per metre */
    double slope_unit;  /* FOAW: m/s per step and sample */
    double tracked[4];  /* tracking: the position, m; x, y, z, 0 */
    double mean[4];     /* tracking: the velocity over some 20 ms, m/s; x, y, z, 0 */
    double mean_share;  /* tracking: weight of a new velocity in it, 0 to 1 */
    double mean_off;    /* tracking: how far it may be off a new one, m/s */
    double half_count;  /* tracking: m */
    double period;      /* s */
    uint32_t tracking;  /* tracking: 1: `tracked` is set */
    uint32_t newest;    /* FOAW: row of the newest position of a ring, 0 to 15 */
    uint32_t started;   /* 1: a position has been seen */
    int32_t method;     /* KNURL_VELOCITY_DIFFERENCE or _FOAW */
    uint32_t avx;       /* FOAW: 1: computed with AVX, if available; 0: the same numbers, more slowly */
    uint32_t stride;    /* FOAW: ticks between samples */
    uint32_t phase;     /* FOAW: the ring of this tick, 0 to stride - 1 */
} knurl_velocity_state;

/* Safe with copies of a knurl_velocity: it is an array of char, so compilers assume that it may alias the state. */
static inline knurl_velocity_state *knurl_velocity_get_state(knurl_velocity *velocity) {
    return (knurl_velocity_state *)(void *)velocity;
}

/* Clears the history: the next position counts as the first. */
static inline void knurl_velocity_reset(knurl_velocity *velocity) {
    knurl_velocity_get_state(velocity)->started = knurl_velocity_get_state(velocity)->tracking = 0;
}

#endif

/* Data from the haptic thread to the game thread, without waiting: the latest tick, a ring of heights and forces, a
 * ring of touches and releases.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_COMMON_BOARD_H
#define KNURL_COMMON_BOARD_H

#include "session.h"

enum { KNURL_BOARD_TICKS = KNURL_SESSION_HISTORY, KNURL_BOARD_CHANGES = 64 };

typedef struct knurl_board_tick {
    double hip[3], velocity[3], proxy[3], force[3]; /* scene axes */
    double impulse[3];                              /* N s: of all forces so far */
    double depth, height, temporal_frequency;
    knurl_surface_id surface;
    uint64_t tick; /* of the HIP, counted from 1 */
    uint64_t sent; /* ticks so far: with those that had no position there are more of the HIP */
} knurl_board_tick;

enum { KNURL_BOARD_WORDS = sizeof(knurl_board_tick) / sizeof(uint64_t) };

typedef struct knurl_board {
    /* atomics */
    uint64_t sequence, words[KNURL_BOARD_WORDS];
    uint64_t tick;                                /* the latest's */
    uint64_t written, history[KNURL_BOARD_TICKS]; /* two floats a tick: m, N along the normal */
    uint64_t changes, changed[KNURL_BOARD_CHANGES];
    /* the haptic thread's */
    knurl_surface_id last;
    double period;     /* s: of a tick */
    double impulse[3]; /* N s */
    double *forces;    /* or null: three a tick, for knurl_session_play() */
    uint64_t force_count, force_capacity;
    /* the game thread's */
    uint64_t seen; /* changes */
} knurl_board;

/* A knurl_tick_callback; user: the board. */
void knurl_board_take(const knurl_tick_output *output, void *user) KNURL_NONBLOCKING;

void knurl_board_read(const knurl_board *b, knurl_board_tick *tick);

/* The latest tick's number alone, for what is asked for each surface that moves. */
uint64_t knurl_board_get_tick(const knurl_board *b);

/* The latest `count` ticks, oldest first, two floats each. Returns how many there were. */
uint32_t knurl_board_history(const knurl_board *b, uint32_t count, float *rows);

/* The surfaces that became the one touched since the last call, oldest first, at most KNURL_BOARD_CHANGES; 0 for none.
 */
uint32_t knurl_board_changes(knurl_board *b, knurl_surface_id *surfaces);

#endif

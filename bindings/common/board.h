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
    uint64_t sent; /* ticks with a position so far */
} knurl_board_tick;

enum { KNURL_BOARD_WORDS = sizeof(knurl_board_tick) / sizeof(uint64_t) };

typedef struct knurl_board {
    /* atomics */
    uint64_t sequence, words[KNURL_BOARD_WORDS];
    uint64_t tick;                                /* of the last tick */
    uint64_t written, history[KNURL_BOARD_TICKS]; /* two floats a tick: m, N along the normal */
    uint64_t changes, changed[KNURL_BOARD_CHANGES];
    /* used by the haptic thread */
    knurl_surface_id last;
    double period;     /* s: of a tick */
    double impulse[3]; /* N s */
    double *forces;    /* or null: three a tick, for knurl_session_play() */
    uint64_t force_count, force_capacity;
    /* used by the game thread */
    uint64_t seen; /* changes read so far */
} knurl_board;

/* A knurl_tick_callback; user: the board. */
void knurl_board_take(const knurl_tick_output *output, void *user) KNURL_NONBLOCKING;

void knurl_board_read(const knurl_board *b, knurl_board_tick *tick);

/* Only the number of the last tick: cheap enough to call for each moving surface. */
uint64_t knurl_board_get_tick(const knurl_board *b);

/* The last `count` ticks, oldest first, two floats each. Returns their number. */
uint32_t knurl_board_history(const knurl_board *b, uint32_t count, float *rows);

/* The surfaces that became the one touched since the last call, oldest first, at most KNURL_BOARD_CHANGES; 0: no
 * surface.
 */
uint32_t knurl_board_changes(knurl_board *b, knurl_surface_id *surfaces);

#endif

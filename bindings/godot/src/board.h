/* What the haptic thread leaves for the game thread, and never waits: the latest tick as it was sent, a ring of heights
 * and forces, a ring of changes of what is touched. SPDX-License-Identifier: MIT */
#ifndef KNURL_GODOT_BOARD_H
#define KNURL_GODOT_BOARD_H

#include <knurl/scene.h>

enum { BOARD_TICKS = 8192, BOARD_CHANGES = 64 };

typedef struct board_tick {
    double hip[3], proxy[3], force[3]; /* scene axes */
    double height, temporal_frequency;
    knurl_surface surface;
    uint64_t tick; /* counted from 1 */
} board_tick;

enum { BOARD_WORDS = sizeof(board_tick) / sizeof(uint64_t) };

typedef struct board {
    /* atomics */
    uint64_t sequence, words[BOARD_WORDS];
    uint64_t written, history[BOARD_TICKS]; /* two floats a tick: m, N along the normal */
    uint64_t changes, changed[BOARD_CHANGES];
    /* the haptic thread's */
    knurl_surface last;
    double *forces; /* or null: three a tick, for play_trace() */
    uint64_t force_count, force_capacity;
    /* the game thread's */
    uint64_t seen; /* changes */
} board;

/* A knurl_tick_callback; user: the board. */
void board_take(const knurl_tick_output *output, void *user);

void board_read(const board *b, board_tick *tick);

/* The latest `count` ticks, oldest first, two floats each. Returns how many there were. */
uint32_t board_history(const board *b, uint32_t count, float *rows);

/* The surfaces that became the one touched since the last call, oldest first, at most BOARD_CHANGES; 0 for none. */
uint32_t board_changes(board *b, knurl_surface *surfaces);

#endif

/* Passes ticks from the haptic thread to one other thread. SPDX-License-Identifier: MIT */
#ifndef KNURL_TOOL_TICK_RING_H
#define KNURL_TOOL_TICK_RING_H

#include <knurl/hip.h>

#include <stdint.h>

#define TICK_RING_ROWS 16384 /* 1.6 s at 10 kHz */

typedef struct tick_ring {
    knurl_tick_output *rows;
    uint64_t written; /* by the haptic thread */
    uint64_t read;    /* by the other thread */
    uint64_t lost;    /* ticks dropped because the ring was full */
} tick_ring;

/* 0, or 1 if memory runs out. */
int tick_ring_create(tick_ring *ring);

/* Adds a tick, or counts it as lost if the ring is full; never waits. [haptic thread] */
void tick_ring_put(tick_ring *ring, const knurl_tick_output *output);

/* The oldest tick, or null; valid until tick_ring_drop(). [the other thread] */
const knurl_tick_output *tick_ring_first(const tick_ring *ring);
void tick_ring_drop(tick_ring *ring);

void tick_ring_destroy(tick_ring *ring);

#endif

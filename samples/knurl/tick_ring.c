/* A ring buffer with one writer and one reader. SPDX-License-Identifier: MIT */
#include "tick_ring.h"

#include <stdlib.h>
#include <string.h>

int tick_ring_create(tick_ring *ring) {
    memset(ring, 0, sizeof *ring);
    ring->rows = malloc(TICK_RING_ROWS * sizeof *ring->rows);
    if (!ring->rows) {
        return 1;
    }
    memset(ring->rows, 0, TICK_RING_ROWS * sizeof *ring->rows); /* touched before the run, not in a tick */
    return 0;
}

void tick_ring_put(tick_ring *ring, const knurl_tick_output *output) {
    const uint64_t read = __atomic_load_n(&ring->read, __ATOMIC_ACQUIRE);
    if (ring->written - read == TICK_RING_ROWS) {
        ring->lost++;
        return;
    }
    ring->rows[ring->written % TICK_RING_ROWS] = *output;
    __atomic_store_n(&ring->written, ring->written + 1, __ATOMIC_RELEASE);
}

const knurl_tick_output *tick_ring_first(const tick_ring *ring) {
    const uint64_t written = __atomic_load_n(&ring->written, __ATOMIC_ACQUIRE);
    return ring->read == written ? NULL : &ring->rows[ring->read % TICK_RING_ROWS];
}

void tick_ring_drop(tick_ring *ring) {
    __atomic_store_n(&ring->read, ring->read + 1, __ATOMIC_RELEASE);
}

void tick_ring_destroy(tick_ring *ring) {
    free(ring->rows);
    ring->rows = NULL;
}

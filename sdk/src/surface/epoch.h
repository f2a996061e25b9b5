/* Deferred freeing: memory that edits replaced is kept until no tick can use it. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_EPOCH_H
#define KNURL_SRC_EPOCH_H

#include "base/heap.h"

/* Threads that pin epochs: one a HIP. */
#define KNURL_PINS_MAX 8

/* The first member of everything that an edit can replace. */
typedef struct knurl_retired {
    struct knurl_retired *next;
    uint64_t epoch; /* ticks that began in this epoch or before may see it */
    void (*release)(knurl_heap *heap, struct knurl_retired *retired);
} knurl_retired;

typedef struct knurl_epoch {
    uint64_t now; /* atomic; from 1 */
    knurl_heap *heap;
    knurl_retired *retired;               /* waits for its release; for edits, under their lock */
    const uint64_t *pins[KNURL_PINS_MAX]; /* atomics: the epoch in which the tick that runs began; 0: none runs */
    uint32_t pin_count;
} knurl_epoch;

/* heap: outlives it; what is retired goes back there. */
void knurl_epoch_init(knurl_epoch *epoch, knurl_heap *heap);

/* One more thread that ticks: where it keeps its pin. */
void knurl_epoch_add_pin(knurl_epoch *epoch, const uint64_t *pin);

/* Around a tick: whatever the tick finds between the two stays readable. [haptic thread] */
static inline void knurl_epoch_pin(const knurl_epoch *epoch, uint64_t *pin) {
    (void)__atomic_exchange_n(pin, __atomic_load_n(&epoch->now, __ATOMIC_SEQ_CST), __ATOMIC_SEQ_CST);
}

static inline void knurl_epoch_unpin(uint64_t *pin) {
    __atomic_store_n(pin, 0, __ATOMIC_RELEASE);
}

/* Releases something once no tick can see it; it can no longer be reached. Under the edits' lock. */
void knurl_epoch_retire(knurl_epoch *epoch, knurl_retired *retired);

/* Releases what no tick can see any more. Under the edits' lock. */
void knurl_epoch_collect(knurl_epoch *epoch);

/* Releases everything: no tick runs any more. */
void knurl_epoch_release_all(knurl_epoch *epoch);

#endif

/* Deferred freeing: memory that edits replaced is kept until no tick can use it. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_EPOCH_H
#define KNURL_SRC_EPOCH_H

#include "base/heap.h"

/* Threads that pin epochs: one per HIP. */
#define KNURL_PINS_MAX 8

/* First member of every object that an edit can replace. */
typedef struct knurl_retired {
    struct knurl_retired *next;
    uint64_t epoch; /* ticks that began in this epoch or earlier may see it */
    void (*release)(knurl_heap *heap, struct knurl_retired *retired);
} knurl_retired;

typedef struct knurl_epoch {
    uint64_t now; /* atomic; from 1 */
    knurl_heap *heap;
    knurl_retired *retired;               /* awaiting release; for edits, under the scene's lock */
    const uint64_t *pins[KNURL_PINS_MAX]; /* atomic: epoch in which the running tick began; 0: no tick runs */
    uint32_t pin_count;
} knurl_epoch;

/* heap: outlives the epoch; retired objects are freed to it. */
void knurl_epoch_init(knurl_epoch *epoch, knurl_heap *heap);

/* Registers the pin of one more thread that ticks. */
void knurl_epoch_add_pin(knurl_epoch *epoch, const uint64_t *pin);

/* Around a tick: every object that the tick finds in between stays readable. [haptic thread] */
static inline void knurl_epoch_pin(const knurl_epoch *epoch, uint64_t *pin) {
    (void)__atomic_exchange_n(pin, __atomic_load_n(&epoch->now, __ATOMIC_SEQ_CST), __ATOMIC_SEQ_CST);
}

static inline void knurl_epoch_unpin(uint64_t *pin) {
    __atomic_store_n(pin, 0, __ATOMIC_RELEASE);
}

/* Keeps an unreachable object until no tick can see it. Under the scene's lock. */
void knurl_epoch_retire(knurl_epoch *epoch, knurl_retired *retired);

/* Takes the retired objects that no tick can see any more off the list. Under the scene's lock. */
knurl_retired *knurl_epoch_take(knurl_epoch *epoch);

/* Releases those, or the list of an epoch in which no tick may run any more. A mesh of a million triangles takes
 * milliseconds: not under the scene's lock. */
void knurl_epoch_release(knurl_heap *heap, knurl_retired *taken);

#endif

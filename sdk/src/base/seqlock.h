/* One writer that never waits, readers that try again: a consistent copy of a small struct for any thread.
 * The words are atomics, so that no access is a data race. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_SEQLOCK_H
#define KNURL_SRC_SEQLOCK_H

#include "base/atomic.h"

#include <stdint.h>
#include <string.h>

/* A seqlock for `type`, whose size is a multiple of 8. Zeroed memory is a valid, zero value. */
#define KNURL_SEQLOCK(type)                                                                                            \
    struct {                                                                                                           \
        uint64_t sequence;                                                                                             \
        uint64_t words[sizeof(type) / sizeof(uint64_t)];                                                               \
    }

static inline void knurl_seqlock_write(uint64_t *sequence, uint64_t *words, const void *value, size_t size) {
    const uint64_t s = knurl_load_relaxed(sequence);
    knurl_store_relaxed(sequence, s + 1);
    __atomic_thread_fence(__ATOMIC_RELEASE);
    for (size_t i = 0; i < size / sizeof(uint64_t); i++) {
        uint64_t word;
        memcpy(&word, (const char *)value + i * sizeof word, sizeof word);
        knurl_store_relaxed(&words[i], word);
    }
    knurl_store_release(sequence, s + 2);
}

static inline void knurl_seqlock_read(const uint64_t *sequence, const uint64_t *words, void *value, size_t size) {
    uint64_t before;
    uint64_t after;
    do { /* the writer is inside for some tens of nanoseconds a tick */
        before = knurl_load_acquire(sequence);
        for (size_t i = 0; i < size / sizeof(uint64_t); i++) {
            const uint64_t word = knurl_load_relaxed(&words[i]);
            memcpy((char *)value + i * sizeof word, &word, sizeof word);
        }
        __atomic_thread_fence(__ATOMIC_ACQUIRE);
        after = knurl_load_relaxed(sequence);
    } while (before != after || before % 2 != 0);
}

#endif

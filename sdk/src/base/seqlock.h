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

/* Compilers leave loops of atomics as they are; there are some 40 words to a tick. */
#if defined(__GNUC__)
#define KNURL_UNROLL _Pragma("GCC unroll 8")
#else
#define KNURL_UNROLL
#endif

/* Without fences, which ThreadSanitizer does not understand; release and acquire are plain moves on x86.
 * Why words that are stored with release and loaded with acquire are enough: a reader whose load sees a word of a write
 * synchronises with that store, and the odd sequence was stored before it. So the reader's later load of the sequence
 * gives the odd number or a newer one, never the even one from before: it tries again. Nor does it see a word older
 * than the write whose even sequence it began with: that was stored with release after all its words. */
static inline void knurl_seqlock_write(uint64_t *sequence, uint64_t *words, const void *value, size_t size) {
    const uint64_t s = knurl_load_relaxed(sequence);
    knurl_store_relaxed(sequence, s + 1);
    KNURL_UNROLL
    for (size_t i = 0; i < size / sizeof(uint64_t); i++) {
        uint64_t word;
        memcpy(&word, (const char *)value + i * sizeof word, sizeof word);
        knurl_store_release(&words[i], word);
    }
    knurl_store_release(sequence, s + 2);
}

static inline void knurl_seqlock_read(const uint64_t *sequence, const uint64_t *words, void *value, size_t size) {
    uint64_t before;
    uint64_t after;
    do { /* the writer is inside for some ten nanoseconds a tick */
        before = knurl_load_acquire(sequence);
        KNURL_UNROLL
        for (size_t i = 0; i < size / sizeof(uint64_t); i++) {
            const uint64_t word = knurl_load_acquire(&words[i]);
            memcpy((char *)value + i * sizeof word, &word, sizeof word);
        }
        after = knurl_load_relaxed(sequence);
    } while (before != after || before % 2 != 0);
}

#endif

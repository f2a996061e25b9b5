/* A sequence lock: one writer that never waits, readers that retry until they have a consistent copy of a small struct.
 * All words are atomics, so there is no data race.
 * SPDX-License-Identifier: MIT */
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

/* Compilers do not unroll loops of atomics; a tick writes some 40 words. */
#if defined(__GNUC__) && !defined(__clang__)
#define KNURL_UNROLL _Pragma("GCC unroll 64")
#else
#define KNURL_UNROLL
#endif

/* A tick spends most of its time on stores: a processor does one per cycle, of 8 or 16 bytes. A reader may see the
 * halves of a 16-byte store one after the other; the proof below needs only that stores keep their order, as on x86. In
 * C such a store would be a data race, hence the assembler. ThreadSanitizer cannot follow it and gets the atomics. */
#if defined(__GNUC__) && defined(__x86_64__) && !defined(__SANITIZE_THREAD__)
#define KNURL_STORES_PAIRS 1
typedef uint64_t knurl_pair __attribute__((vector_size(16), aligned(8), may_alias));
#else
#define KNURL_STORES_PAIRS 0
#endif

/* To write: begin, put the parts (sizes are multiples of 8), end.
 *
 * No fences, because ThreadSanitizer does not support them; release and acquire are plain moves on x86. Proof that they
 * suffice: a reader that loads a word of a new write synchronises with that store, before which the odd sequence was
 * stored; so the reader's second load of the sequence cannot return the old even number, and it retries. A reader never
 * gets a word older than the write whose even sequence it began with, because that was stored with release after all
 * its words. */
static inline void knurl_seqlock_begin(uint64_t *sequence) {
    knurl_store_relaxed(sequence, knurl_load_relaxed(sequence) + 1);
}

static inline void knurl_seqlock_put(uint64_t *words, const void *value, size_t size) {
    const char *from = value;
    size_t left = size / sizeof(uint64_t);
#if KNURL_STORES_PAIRS
    KNURL_UNROLL
    for (; left > 1; left -= 2) {
        knurl_pair two;
        uint64_t first, second;
        memcpy(&first, from, sizeof first);
        memcpy(&second, from + sizeof first, sizeof second);
        two = (knurl_pair){first, second};
        __asm__ volatile("movups %1, %0" : "=m"(*(knurl_pair *)(void *)words) : "x"(two) : "memory");
        from += sizeof two;
        words += 2;
    }
#endif
    KNURL_UNROLL
    for (; left > 0; left--) {
        uint64_t word;
        memcpy(&word, from, sizeof word);
        knurl_store_release(words, word);
        from += sizeof word;
        words++;
    }
}

static inline void knurl_seqlock_end(uint64_t *sequence) {
    knurl_store_release(sequence, knurl_load_relaxed(sequence) + 1);
}

static inline void knurl_seqlock_write(uint64_t *sequence, uint64_t *words, const void *value, size_t size) {
    knurl_seqlock_begin(sequence);
    knurl_seqlock_put(words, value, size);
    knurl_seqlock_end(sequence);
}

/* Tries once: 1 if *value is consistent, 0 if a write was in progress. For a reader that must not wait. */
static inline int knurl_seqlock_try_read(const uint64_t *sequence, const uint64_t *words, void *value, size_t size) {
    const uint64_t before = knurl_load_acquire(sequence);
    for (size_t i = 0; i < size / sizeof(uint64_t); i++) {
        const uint64_t word = knurl_load_acquire(&words[i]);
        memcpy((char *)value + i * sizeof word, &word, sizeof word);
    }
    return before % 2 == 0 && before == knurl_load_relaxed(sequence);
}

static inline void knurl_seqlock_read(const uint64_t *sequence, const uint64_t *words, void *value, size_t size) {
    while (!knurl_seqlock_try_read(sequence, words, value, size)) {} /* a write takes some ten ns per tick */
}

#endif

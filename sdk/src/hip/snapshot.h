/* A consistent copy of a HIP's last tick and counts, for any thread. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_SNAPSHOT_H
#define KNURL_SRC_SNAPSHOT_H

#include "base/base.h"
#include "base/seqlock.h"

#include <knurl/hip.h>

#include <stddef.h>

typedef struct knurl_snapshot {
    knurl_tick_output output;
    knurl_hip_counts counts;
} knurl_snapshot;

typedef KNURL_SEQLOCK(knurl_snapshot) knurl_published;

/* Slow path of knurl_counts_add(). */
void knurl_counts_add_flags(knurl_hip_counts *counts, uint32_t flags) KNURL_NONBLOCKING;

/* Counts a tick whose force had this length (N). */
static inline void knurl_counts_add(knurl_hip_counts *counts, const knurl_tick_output *output, double force) {
    counts->ticks++;
    counts->contact_ticks += (output->flags & KNURL_TICK_CONTACT) != 0;
    if (KNURL_UNLIKELY(output->flags & ~(uint32_t)KNURL_TICK_CONTACT)) {
        knurl_counts_add_flags(counts, output->flags);
    }
    counts->force_max = force > counts->force_max ? force : counts->force_max;
}

/* Publishes the counts from offset `from` up to `to`. */
static inline void knurl_snapshot_put(knurl_published *published, const knurl_hip_counts *counts, size_t from,
                                      size_t to) {
    const size_t word = (offsetof(knurl_snapshot, counts) + from) / sizeof(uint64_t);
    knurl_seqlock_put(&published->words[word], (const char *)counts + from, to - from);
}

/* Publishes a tick that has just been counted. Counts of rare flags are skipped if the tick has no such flag, and
 * reserved words are never written. Never waits. [one thread: the haptic one] */
static inline void knurl_snapshot_publish(knurl_published *published, const knurl_tick_output *output,
                                          const knurl_hip_counts *counts) {
    const size_t rare = offsetof(knurl_hip_counts, force_limit_ticks), after = offsetof(knurl_hip_counts, force_max);
    const size_t rare_too = offsetof(knurl_hip_counts, squeezed_ticks);
    knurl_seqlock_begin(&published->sequence);
    knurl_seqlock_put(published->words, output, offsetof(knurl_tick_output, reserved));
    knurl_snapshot_put(published, counts, 0, rare);
    if (KNURL_UNLIKELY(output->flags & ~(uint32_t)KNURL_TICK_CONTACT)) {
        knurl_snapshot_put(published, counts, rare, after);
        knurl_snapshot_put(published, counts, rare_too, offsetof(knurl_hip_counts, reserved));
    }
    knurl_snapshot_put(published, counts, after, rare_too);
    knurl_seqlock_end(&published->sequence);
}

/* Publishes zeros, as before the first tick. [instead of the haptic thread] */
void knurl_snapshot_clear(knurl_published *published);

/* [any thread] */
void knurl_snapshot_read(const knurl_published *published, knurl_snapshot *snapshot) KNURL_NONBLOCKING;

#endif

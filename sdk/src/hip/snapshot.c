/* Counts flags and publishes snapshots. SPDX-License-Identifier: MIT */
#include "hip/snapshot.h"

void knurl_counts_add_flags(knurl_hip_counts *c, uint32_t flags) {
    c->force_limit_ticks += (flags & KNURL_TICK_FORCE_LIMIT) != 0;
    c->above_nyquist_ticks += (flags & KNURL_TICK_ABOVE_NYQUIST) != 0;
    c->non_finite_ticks += (flags & KNURL_TICK_NOT_FINITE) != 0;
    c->entry_ticks += (flags & KNURL_TICK_ENTRY) != 0;
    c->slew_ticks += (flags & KNURL_TICK_SLEW) != 0;
    c->heat_ticks += (flags & KNURL_TICK_HEAT) != 0;
    c->passivity_ticks += (flags & KNURL_TICK_PASSIVITY) != 0;
    c->squeezed_ticks += (flags & KNURL_TICK_SQUEEZED) != 0;
    c->visit_limit_ticks += (flags & KNURL_TICK_VISIT_LIMIT) != 0;
}

void knurl_snapshot_clear(knurl_published *published) {
    static const knurl_snapshot none;
    knurl_seqlock_write(&published->sequence, published->words, &none, sizeof none);
}

void knurl_snapshot_read(const knurl_published *published, knurl_snapshot *snapshot) {
    knurl_seqlock_read(&published->sequence, published->words, snapshot, sizeof *snapshot);
}

/* Data from the haptic thread to the game thread. SPDX-License-Identifier: MIT */
#include "board.h"

#include "base/seqlock.h"

#include <string.h>

void knurl_board_take(const knurl_tick_output *output, void *user) {
    knurl_board *b = user;
    knurl_board_tick tick;
    memcpy(tick.hip, output->hip, sizeof tick.hip);
    memcpy(tick.velocity, output->hip_velocity, sizeof tick.velocity);
    memcpy(tick.proxy, output->proxy, sizeof tick.proxy);
    memcpy(tick.force, output->force, sizeof tick.force);
    for (int i = 0; i < 3; i++) {
        b->impulse[i] += b->period * output->force[i];
    }
    memcpy(tick.impulse, b->impulse, sizeof tick.impulse);
    tick.depth = output->depth;
    tick.height = output->height;
    tick.temporal_frequency = output->temporal_frequency;
    tick.surface = output->surface;
    tick.tick = output->tick + 1;
    const uint64_t written = __atomic_load_n(&b->written, __ATOMIC_RELAXED);
    tick.sent = written + 1;
    knurl_seqlock_write(&b->sequence, b->words, &tick, sizeof tick);
    __atomic_store_n(&b->tick, tick.tick, __ATOMIC_RELEASE);
    float row[2] = {(float)output->height, 0.0F};
    for (int i = 0; i < 3; i++) {
        row[1] += (float)(output->force[i] * output->normal[i]);
    }
    uint64_t packed;
    memcpy(&packed, row, sizeof packed);
    __atomic_store_n(&b->history[written % KNURL_BOARD_TICKS], packed, __ATOMIC_RELEASE);
    __atomic_store_n(&b->written, written + 1, __ATOMIC_RELEASE);
    if (output->surface != b->last) {
        const uint64_t changes = __atomic_load_n(&b->changes, __ATOMIC_RELAXED);
        b->last = output->surface;
        __atomic_store_n(&b->changed[changes % KNURL_BOARD_CHANGES], output->surface, __ATOMIC_RELEASE);
        __atomic_store_n(&b->changes, changes + 1, __ATOMIC_RELEASE);
    }
    if (b->force_count < b->force_capacity) {
        memcpy(b->forces + 3 * b->force_count++, output->force, 3 * sizeof *b->forces);
    }
}

void knurl_board_read(const knurl_board *b, knurl_board_tick *tick) {
    knurl_seqlock_read(&b->sequence, b->words, tick, sizeof *tick);
}

uint64_t knurl_board_get_tick(const knurl_board *b) {
    return __atomic_load_n(&b->tick, __ATOMIC_ACQUIRE);
}

/* Copies a ring's entries from `begin` on, at most as many as it holds. Leaves out entries that were overwritten
 * meanwhile and the slot that may be written now. */
static uint32_t copy_ring(const uint64_t *written, const uint64_t *ring, uint64_t room, uint64_t begin, uint64_t end,
                          void *to) {
    unsigned char *out = to;
    begin = end - begin > room ? end - room : begin;
    for (uint64_t i = begin; i < end; i++) {
        const uint64_t word = __atomic_load_n(&ring[i % room], __ATOMIC_ACQUIRE);
        memcpy(out + (i - begin) * sizeof word, &word, sizeof word);
    }
    const uint64_t now = __atomic_load_n(written, __ATOMIC_ACQUIRE) + 1;
    const uint64_t oldest = now > room ? now - room : 0;
    if (oldest > begin) {
        const uint64_t lost = oldest - begin < end - begin ? oldest - begin : end - begin;
        memmove(out, out + lost * sizeof *ring, (size_t)(end - begin - lost) * sizeof *ring);
        begin += lost;
    }
    return (uint32_t)(end - begin);
}

uint32_t knurl_board_history(const knurl_board *b, uint32_t count, float *rows) {
    const uint64_t end = __atomic_load_n(&b->written, __ATOMIC_ACQUIRE);
    return copy_ring(&b->written, b->history, KNURL_BOARD_TICKS, end > count ? end - count : 0, end, rows);
}

uint32_t knurl_board_changes(knurl_board *b, knurl_surface_id *surfaces) {
    const uint64_t begin = b->seen;
    b->seen = __atomic_load_n(&b->changes, __ATOMIC_ACQUIRE);
    return copy_ring(&b->changes, b->changed, KNURL_BOARD_CHANGES, begin, b->seen, surfaces);
}

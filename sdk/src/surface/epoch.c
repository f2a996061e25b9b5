/* A tick pins the epoch in which it begins. An object retired in an epoch is freed once every HIP is idle or has begun
 * a tick in a later epoch. All accesses to `now`, the pins and the swapped pointers are sequentially consistent: either
 * this code sees the tick's pin, or the tick sees the new pointer (Fraser 2004, chapter 5).
 * SPDX-License-Identifier: MIT */
#include "surface/epoch.h"

void knurl_epoch_init(knurl_epoch *epoch, knurl_heap *heap) {
    epoch->now = 1;
    epoch->heap = heap;
    epoch->retired = NULL;
    epoch->pin_count = 0;
}

void knurl_epoch_add_pin(knurl_epoch *epoch, const uint64_t *pin) {
    epoch->pins[epoch->pin_count++] = pin;
}

knurl_retired *knurl_epoch_take(knurl_epoch *epoch) {
    uint64_t oldest = UINT64_MAX; /* epoch in which a running tick began */
    for (uint32_t i = 0; i < epoch->pin_count && epoch->retired; i++) {
        const uint64_t pinned = __atomic_load_n(epoch->pins[i], __ATOMIC_SEQ_CST);
        if (pinned != 0 && pinned < oldest) {
            oldest = pinned;
        }
    }
    knurl_retired *taken = NULL;
    knurl_retired **link = &epoch->retired;
    while (*link) {
        knurl_retired *retired = *link;
        if (retired->epoch < oldest) {
            *link = retired->next;
            retired->next = taken;
            taken = retired;
        } else {
            link = &retired->next;
        }
    }
    return taken;
}

void knurl_epoch_retire(knurl_epoch *epoch, knurl_retired *retired) {
    retired->epoch = __atomic_fetch_add(&epoch->now, 1, __ATOMIC_SEQ_CST);
    retired->next = epoch->retired;
    epoch->retired = retired;
}

void knurl_epoch_release(knurl_heap *heap, knurl_retired *taken) {
    while (taken) {
        knurl_retired *retired = taken;
        taken = retired->next;
        retired->release(heap, retired);
    }
}

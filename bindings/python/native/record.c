/* SPDX-License-Identifier: MIT */
#include "record.h"

void knurl_record_put(const knurl_tick_output *output, void *user) {
    knurl_record *record = user;
    const uint64_t read = __atomic_load_n(&record->read, __ATOMIC_ACQUIRE);
    if (record->written - read == record->capacity) {
        __atomic_store_n(&record->lost, record->lost + 1, __ATOMIC_RELAXED);
        return;
    }
    record->rows[record->written % record->capacity] = *output;
    __atomic_store_n(&record->written, record->written + 1, __ATOMIC_RELEASE);
}

uint64_t knurl_record_take(knurl_record *record, knurl_tick_output *rows, uint64_t count) {
    const uint64_t available = __atomic_load_n(&record->written, __ATOMIC_ACQUIRE) - record->read;
    const uint64_t taken = count < available ? count : available;
    for (uint64_t i = 0; i < taken; i++) {
        rows[i] = record->rows[(record->read + i) % record->capacity];
    }
    __atomic_store_n(&record->read, record->read + taken, __ATOMIC_RELEASE);
    return taken;
}

/* Finds vertices at the same position, which uv seams and hard edges duplicate. SPDX-License-Identifier: MIT */
#include "contact/weld.h"

#include "contact/seeded_hash.h"

#include <string.h>

static uint64_t hash_position(const knurl_seeded_hash *hash, const float *p) {
    uint32_t bits[3];
    for (int axis = 0; axis < 3; axis++) {
        const float value = p[axis] + 0.0f; /* -0 and 0 are the same position */
        memcpy(&bits[axis], &value, sizeof value);
    }
    return knurl_seeded_hash_of(hash, bits[0], bits[1], bits[2]);
}

uint64_t knurl_table_slots(uint64_t entries) {
    uint64_t slots = 16;
    while (slots < 2 * entries) {
        slots *= 2;
    }
    return slots;
}

knurl_result knurl_mesh_weld(knurl_heap *heap, const knurl_mesh_desc *desc, int marked, uint32_t *welds) {
    const uint64_t slots = knurl_table_slots(desc->vertex_count);
    uint32_t *table = knurl_heap_alloc(heap, slots, sizeof *table); /* vertex + 1, or 0 */
    knurl_seeded_hash hash;
    if (!table) {
        return KNURL_ERROR_MEMORY;
    }
    knurl_seeded_hash_init(&hash, heap->seed);
    for (uint32_t v = 0; v < desc->vertex_count; v++) {
        if (marked && !welds[v]) {
            continue;
        }
        const float *p = &desc->positions[3 * (size_t)v];
        uint64_t slot = hash_position(&hash, p) & (slots - 1);
        while (table[slot] != 0) {
            const float *q = &desc->positions[3 * (size_t)(table[slot] - 1)];
            if (p[0] == q[0] && p[1] == q[1] && p[2] == q[2]) {
                break;
            }
            slot = (slot + 1) & (slots - 1);
        }
        if (table[slot] == 0) {
            table[slot] = v + 1;
        }
        welds[v] = table[slot] - 1;
    }
    knurl_heap_free(heap, table);
    return KNURL_OK;
}

/* Hash table of the edges of a triangle sheet, to find those without a neighbour. SPDX-License-Identifier: MIT */
#include "contact/edge_table.h"

#include <string.h>

/* A slot: lower vertex, higher vertex (28 bits each: a mesh has at most 2^28), and the directions in use. */
#define VERTEX_BITS 28
#define UPWARDS     ((uint64_t)1 << 62)
#define DOWNWARDS   ((uint64_t)1 << 63)
#define USES        (UPWARDS | DOWNWARDS)

/* Maximum collisions per slot. A table of random keys has 1 when it is two thirds full (Knuth, 6.4, linear probing). */
#define STEPS_MAX 64

static uint64_t slots_for(uint64_t edges) {
    uint64_t slots = 16;
    while (slots < edges + edges / 2) {
        slots *= 2;
    }
    return slots;
}

knurl_result knurl_edges_make(knurl_heap *heap, uint64_t edges, knurl_edge_table *table) {
    table->capacity = slots_for(edges);
    table->mask = table->capacity - 1;
    table->slots = knurl_heap_alloc(heap, table->capacity, sizeof *table->slots);
    return table->slots ? KNURL_OK : KNURL_ERROR_MEMORY;
}

void knurl_edges_clear(knurl_edge_table *table, uint64_t edges) {
    const uint64_t slots = slots_for(edges);
    table->mask = (slots < table->capacity ? slots : table->capacity) - 1;
    table->steps = 0;
    memset(table->slots, 0, (size_t)(table->mask + 1) * sizeof *table->slots);
}

int knurl_edges_add(knurl_edge_table *table, uint32_t from, uint32_t to) {
    const uint64_t way = from < to ? UPWARDS : DOWNWARDS;
    const uint64_t key = from < to ? (uint64_t)from << VERTEX_BITS | to : (uint64_t)to << VERTEX_BITS | from;
    uint64_t hash = key * 0x9e3779b97f4a7c15u;
    hash ^= hash >> 32;
    uint64_t slot = hash & table->mask;
    while (table->slots[slot] != 0 && (table->slots[slot] & ~USES) != key) {
        slot = (slot + 1) & table->mask;
        table->steps++;
    }
    if (table->slots[slot] & way || table->steps > STEPS_MAX * (table->mask + 1)) {
        return 0;
    }
    table->slots[slot] |= key | way;
    return 1;
}

int knurl_edges_next(const knurl_edge_table *table, uint64_t *at, uint32_t edge[2]) {
    for (; *at <= table->mask; ++*at) {
        const uint64_t slot = table->slots[*at];
        const uint64_t uses = slot & USES;
        if (uses == UPWARDS || uses == DOWNWARDS) {
            const uint32_t low = (uint32_t)((slot & ~USES) >> VERTEX_BITS);
            const uint32_t high = (uint32_t)(slot & (((uint64_t)1 << VERTEX_BITS) - 1));
            edge[0] = uses == UPWARDS ? low : high;
            edge[1] = uses == UPWARDS ? high : low;
            ++*at;
            return 1;
        }
    }
    return 0;
}

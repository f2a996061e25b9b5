/* Hash table of the edges of a triangle sheet, to find those without a neighbour. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_EDGE_TABLE_H
#define KNURL_SRC_EDGE_TABLE_H

#include "base/heap.h"

/* Directed edges between welded vertices, each stored with its reverse. */
typedef struct knurl_edge_table {
    uint64_t *slots;
    uint64_t capacity; /* a power of two */
    uint64_t mask;     /* slots in use - 1 */
    uint64_t steps;    /* collisions since the last clear */
} knurl_edge_table;

/* Allocates room for `edges` different edges. Errors: KNURL_ERROR_MEMORY. */
knurl_result knurl_edges_make(knurl_heap *heap, uint64_t edges, knurl_edge_table *table);

/* Empties the table, for at most `edges` edges. */
void knurl_edges_clear(knurl_edge_table *table, uint64_t edges);

/* Returns 0 if the edge is already present, or if there are more collisions than chance gives: a crafted mesh, which
 * does not become a plane. (The hash has no seed: the order of its slots is the order of the outline's edges.) */
int knurl_edges_add(knurl_edge_table *table, uint32_t from, uint32_t to);

/* Finds the next edge without a reverse, from slot *at on; 0 at the end. */
int knurl_edges_next(const knurl_edge_table *table, uint64_t *at, uint32_t edge[2]);

#endif

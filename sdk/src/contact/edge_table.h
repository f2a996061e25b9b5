/* Which edges of a sheet of triangles have a neighbour. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_EDGE_TABLE_H
#define KNURL_SRC_EDGE_TABLE_H

#include "base/heap.h"

/* Directed edges between welded vertices, each with the one that runs back. */
typedef struct knurl_edge_table {
    uint64_t *slots;
    uint64_t capacity; /* a power of two */
    uint64_t mask;     /* of the part in use */
    uint64_t steps;    /* to slots that others had, since it was emptied */
} knurl_edge_table;

/* Room for so many different edges. Errors: KNURL_ERROR_MEMORY. */
knurl_result knurl_edges_make(knurl_heap *heap, uint64_t edges, knurl_edge_table *table);

/* Empties it, for at most so many edges. */
void knurl_edges_clear(knurl_edge_table *table, uint64_t edges);

/* 0 where this edge is there already, or where the table has more collisions than chance gives: what is in it was made
 * so, and the mesh stays one. (Its hash has no seed: the order of its slots is the order of the outline's edges.) */
int knurl_edges_add(knurl_edge_table *table, uint32_t from, uint32_t to);

/* The next edge at or after slot *at that no other runs back along; 0 when there is none left. */
int knurl_edges_next(const knurl_edge_table *table, uint64_t *at, uint32_t edge[2]);

#endif

/* An object's memory: the caller's allocator, counted, lockable into RAM. Not for use in a tick.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_HEAP_H
#define KNURL_SRC_HEAP_H

#include "base/system.h"

#include <knurl/base.h>

typedef struct knurl_block knurl_block;

typedef struct knurl_heap {
    knurl_allocator allocator;
    knurl_block *first;
    knurl_block *spares; /* locked blocks that were given back and wait for another of their size */
    uint32_t spare_count;
    uint32_t reserved;
    uint64_t bytes;    /* held now, headers and spares included */
    uint64_t locked;   /* 1: locked into RAM, what comes later too; unlocked when given back */
    uint64_t seed;     /* of its hash tables; random, so that a file cannot be made to collide in them */
    knurl_mutex *lock; /* null: one thread at a time. The caller's functions are called under it */
} knurl_heap;

/* allocator: null for malloc and free. */
void knurl_heap_init(knurl_heap *heap, const knurl_allocator *allocator);

/* count * size zeroed bytes, aligned to 64; null (with an error message) when there are none, or on overflow. */
void *knurl_heap_alloc(knurl_heap *heap, uint64_t count, size_t size);

/* Bytes held now, headers included. */
uint64_t knurl_heap_bytes(const knurl_heap *heap);

/* Gives one allocation back; null is allowed. */
void knurl_heap_free(knurl_heap *heap, void *memory);

/* The bytes that an allocation costs, header included; 0 for null. */
uint64_t knurl_heap_size(const void *memory);

/* Locks all of it into RAM. Errors: KNURL_ERROR_SYSTEM. */
knurl_result knurl_heap_lock(knurl_heap *heap);

#endif

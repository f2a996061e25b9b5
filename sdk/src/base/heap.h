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
    knurl_block *spares; /* freed blocks, still locked, for reuse at the same size */
    uint32_t spare_count;
    uint32_t reserved;
    uint64_t bytes;    /* allocated now, with headers and spares */
    uint64_t locked;   /* 1: locked into RAM, with later blocks; unlocked when freed */
    uint64_t seed;     /* for hash tables; random, so that a file cannot be made to collide in them */
    knurl_mutex *lock; /* held while the caller's functions run; null: used by one thread at a time */
} knurl_heap;

/* allocator: null for malloc and free. */
void knurl_heap_init(knurl_heap *heap, const knurl_allocator *allocator);

/* count * size zeroed bytes, aligned to 64; null, with an error message, if memory runs out or the size overflows. */
void *knurl_heap_alloc(knurl_heap *heap, uint64_t count, size_t size);

/* Bytes allocated now, with headers. */
uint64_t knurl_heap_bytes(const knurl_heap *heap);

/* Frees one allocation; null is allowed. */
void knurl_heap_free(knurl_heap *heap, void *memory);

/* The size of an allocation with its header, in bytes; 0 for null. */
uint64_t knurl_heap_size(const void *memory);

/* Locks all blocks, present and future, into RAM. Errors: KNURL_ERROR_SYSTEM. */
knurl_result knurl_heap_lock(knurl_heap *heap);

#endif

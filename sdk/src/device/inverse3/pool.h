/* Memory for libwebsockets, had before it is called: where it gets none it leaks, or crashes.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_INVERSE3_POOL_H
#define KNURL_SRC_INVERSE3_POOL_H

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Bytes. Version 4.1 takes 30 KB for a connection, however long it lasts, of which 16 are the buffer that it is told to
 * make. */
#define KNURL_POOL_ROOM ((size_t)128 * 1024)

/* Blocks are taken from its start on, each behind its size. The last one that was taken makes room when it is given
 * back, all others do so with the pool. */
typedef struct knurl_pool {
    size_t used;
    size_t last; /* where the last block is; `used`: none is known */
    unsigned char bytes[KNURL_POOL_ROOM] __attribute__((aligned(16)));
} knurl_pool;

#define KNURL_POOL_HEADER ((size_t)16)

static inline int knurl_pool_has(const knurl_pool *pool, const void *memory) {
    const uintptr_t at = (uintptr_t)memory;
    return pool && at >= (uintptr_t)pool->bytes && at < (uintptr_t)pool->bytes + KNURL_POOL_ROOM;
}

static inline void *knurl_pool_take(knurl_pool *pool, size_t size) {
    const size_t rounded = (size + 15) / 16 * 16;
    if (!pool || size > KNURL_POOL_ROOM || KNURL_POOL_ROOM - pool->used < KNURL_POOL_HEADER + rounded) {
        return malloc(size);
    }
    unsigned char *block = pool->bytes + pool->used;
    memcpy(block, &size, sizeof size);
    pool->last = pool->used;
    pool->used += KNURL_POOL_HEADER + rounded;
    return block + KNURL_POOL_HEADER;
}

static inline void knurl_pool_give_back(knurl_pool *pool, void *memory) {
    if (!knurl_pool_has(pool, memory)) {
        free(memory);
    } else if ((unsigned char *)memory == pool->bytes + pool->last + KNURL_POOL_HEADER) {
        pool->used = pool->last;
    }
}

/* As realloc(), but that a size of 0 gives the block back. pool: null for the heap alone; else what does not fit into
 * it comes from the heap. */
static inline void *knurl_pool_realloc(knurl_pool *pool, void *memory, size_t size) {
    size_t old = 0;
    if (size == 0) {
        knurl_pool_give_back(pool, memory);
        return NULL;
    }
    if (memory && !knurl_pool_has(pool, memory)) {
        return realloc(memory, size);
    }
    void *made = knurl_pool_take(pool, size);
    if (made && memory) {
        memcpy(&old, (unsigned char *)memory - KNURL_POOL_HEADER, sizeof old);
        memcpy(made, memory, old < size ? old : size);
    }
    return made;
}

#endif

/* Memory for libwebsockets, allocated before it is called: if its allocations fail, it leaks or crashes.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_INVERSE3_POOL_H
#define KNURL_SRC_INVERSE3_POOL_H

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Bytes. Version 4.1 takes 30 KB per connection, however long that lasts, including the 16 KB of pt_serv_buf_size. */
#define KNURL_POOL_ROOM ((size_t)128 * 1024)

/* Blocks are taken from its start, each after its size. Freeing the last block makes room; all others are freed with
 * the pool. */
typedef struct knurl_pool {
    size_t used;
    size_t last; /* offset of the last block; `used` if unknown */
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

/* As realloc(), except that a size of 0 frees the block. pool: if null, uses the heap alone; otherwise the heap is used
 * for blocks that do not fit. */
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

/* Counted memory from a caller's allocator. SPDX-License-Identifier: MIT */
#include "base/heap.h"

#include "base/system.h"

#include <stdlib.h>
#include <string.h>

#define ALIGNMENT 64 /* a cache line */

/* Locking a block is a system call of some microseconds, and a moving surface needs a new record each frame: small
 * blocks of a locked heap are kept for reuse. */
#define SPARE_BYTES ((size_t)2048)
#define SPARES      64u

struct knurl_block {
    knurl_block *next;
    knurl_block *previous;
    size_t size; /* including this header */
};

/* Returns zeroed memory. C99 has no aligned allocation: the pointer from calloc() is stored just before the aligned
 * block. */
static void *default_allocate(size_t size, size_t alignment, void *user) {
    (void)user;
    if (size > SIZE_MAX - alignment - sizeof(void *)) {
        return NULL;
    }
    char *raw = calloc(1, size + alignment + sizeof raw); /* knows which pages are zero already */
    if (!raw) {
        return NULL;
    }
    const uintptr_t start = (uintptr_t)raw + sizeof raw;
    char *aligned = raw + sizeof raw + (alignment - start % alignment) % alignment;
    memcpy(aligned - sizeof raw, &raw, sizeof raw);
    return aligned;
}

static void default_release(void *memory, size_t size, void *user) {
    char *raw;
    (void)size;
    (void)user;
    memcpy(&raw, (char *)memory - sizeof raw, sizeof raw);
    free(raw);
}

void knurl_heap_init(knurl_heap *heap, const knurl_allocator *allocator) {
    memset(heap, 0, sizeof *heap);
    heap->seed = (uint64_t)knurl_system_now_ns() ^ (uint64_t)(uintptr_t)heap << 20;
    if (allocator) {
        heap->allocator = *allocator;
    } else {
        heap->allocator.allocate = default_allocate;
        heap->allocator.release = default_release;
    }
}

static void enter(const knurl_heap *heap) {
    if (heap->lock) {
        knurl_system_mutex_lock(heap->lock);
    }
}

static void leave(const knurl_heap *heap) {
    if (heap->lock) {
        knurl_system_mutex_unlock(heap->lock);
    }
}

static knurl_block *take_spare(knurl_heap *heap, size_t bytes) {
    for (knurl_block **at = &heap->spares; *at; at = &(*at)->next) {
        if ((*at)->size == bytes) {
            knurl_block *block = *at;
            *at = block->next;
            heap->spare_count--;
            return block;
        }
    }
    return NULL;
}

static void link_block(knurl_heap *heap, knurl_block *block) {
    block->next = heap->first;
    block->previous = NULL;
    if (heap->first) {
        heap->first->previous = block;
    }
    heap->first = block;
}

/* Gets a block from the caller's allocator. */
static knurl_block *make_block(knurl_heap *heap, size_t bytes) {
    knurl_block *block = bytes ? heap->allocator.allocate(bytes, ALIGNMENT, heap->allocator.user) : NULL;
    if (block) {
        block->size = bytes;
        heap->bytes += bytes;
        if (heap->locked) {
            (void)knurl_system_lock_memory(block, bytes); /* if refused, a tick may wait for a page */
        }
    }
    return block;
}

/* is_locked: the heap's `locked`, which is read under its lock. */
static void release_block(const knurl_heap *heap, knurl_block *block, uint64_t is_locked) {
    if (is_locked) { /* unlocks whole pages, with any neighbours in them */
        knurl_system_unlock_memory(block, block->size);
    }
    heap->allocator.release(block, block->size, heap->allocator.user);
}

/* Called when the last block in use is freed. */
static void release_spares(knurl_heap *heap) {
    while (heap->spares) {
        knurl_block *block = heap->spares;
        heap->spares = block->next;
        heap->bytes -= block->size;
        release_block(heap, block, heap->locked);
    }
    heap->spare_count = 0;
}

void *knurl_heap_alloc(knurl_heap *heap, uint64_t count, size_t size) {
    const uint64_t limit = (SIZE_MAX - ALIGNMENT) / (size ? size : 1);
    const size_t bytes = count > limit ? 0 : ALIGNMENT + (size_t)count * size;
    enter(heap);
    knurl_block *block = take_spare(heap, bytes);
    const int is_zeroed = !block && heap->allocator.allocate == default_allocate;
    block = block ? block : make_block(heap, bytes);
    if (block) {
        link_block(heap, block);
    }
    leave(heap);
    if (!block) {
        knurl_fail(KNURL_ERROR_MEMORY, "memory: could not get %llu x %llu bytes", (unsigned long long)count,
                   (unsigned long long)size);
        return NULL;
    }
    if (!is_zeroed) {
        memset((char *)block + ALIGNMENT, 0, bytes - ALIGNMENT);
    }
    return (char *)block + ALIGNMENT;
}

void knurl_heap_free(knurl_heap *heap, void *memory) {
    if (!memory) {
        return;
    }
    knurl_block *block = (knurl_block *)(void *)((char *)memory - ALIGNMENT);
    enter(heap);
    if (block->previous) {
        block->previous->next = block->next;
    } else {
        heap->first = block->next;
    }
    if (block->next) {
        block->next->previous = block->previous;
    }
    if (heap->locked && block->size <= SPARE_BYTES && heap->spare_count < SPARES && heap->first) {
        block->next = heap->spares;
        heap->spares = block;
        heap->spare_count++;
        block = NULL;
    } else {
        heap->bytes -= block->size;
    }
    if (!heap->first) {
        release_spares(heap);
    }
    const int is_ours = heap->allocator.release == default_release;
    const uint64_t is_locked = heap->locked;
    if (block && !is_ours) {
        release_block(heap, block, is_locked);
    }
    leave(heap);
    if (block && is_ours) { /* free() has locks of its own, and takes milliseconds for a large block */
        release_block(heap, block, is_locked);
    }
}

uint64_t knurl_heap_bytes(const knurl_heap *heap) {
    enter(heap);
    const uint64_t bytes = heap->bytes;
    leave(heap);
    return bytes;
}

uint64_t knurl_heap_size(const void *memory) {
    return memory ? ((const knurl_block *)(const void *)((const char *)memory - ALIGNMENT))->size : 0;
}

knurl_result knurl_heap_lock(knurl_heap *heap) {
    int refused = 0;
    enter(heap);
    heap->locked = 1;
    for (knurl_block *block = heap->first; block && !refused; block = block->next) {
        refused = !knurl_system_lock_memory(block, block->size);
    }
    const uint64_t bytes = heap->bytes;
    leave(heap);
    if (refused) {
        return knurl_fail(KNURL_ERROR_SYSTEM, "memory: the system refused to lock %llu bytes into RAM (see ulimit -l)",
                          (unsigned long long)bytes);
    }
    return KNURL_OK;
}

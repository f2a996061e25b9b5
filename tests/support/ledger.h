/* A caller's allocator that keeps books, and can refuse. SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_LEDGER_H
#define KNURL_TEST_LEDGER_H

#include "support/scenes.h"

/** Memory with its books: nothing may be given back wrongly, and the n-th request may be refused. */
typedef struct ledger {
    uint64_t bytes;
    int32_t blocks;
    int32_t requests;
    int32_t refused; /* the allocation that fails, counted from 1; 0: no allocation */
} ledger;

static inline void *take(size_t size, size_t alignment, void *user) {
    ledger *books = user;
    assert_true(size > 0 && alignment > 0 && (alignment & (alignment - 1)) == 0);
    if (++books->requests == books->refused) {
        return NULL;
    }
    char *raw = malloc(size + 2 * alignment + sizeof(size_t) + sizeof raw);
    assert_non_null(raw);
    char *memory = raw + sizeof(size_t) + sizeof raw;
    memory += (alignment - (uintptr_t)memory % alignment) % alignment;
    memcpy(memory - sizeof raw, &raw, sizeof raw);
    memcpy(memory - sizeof raw - sizeof size, &size, sizeof size);
    memset(memory, 0x5a, size);
    books->bytes += size;
    books->blocks++;
    return memory;
}

static inline void give_back(void *memory, size_t size, void *user) {
    ledger *books = user;
    char *raw;
    size_t taken;
    memcpy(&raw, (char *)memory - sizeof raw, sizeof raw);
    memcpy(&taken, (char *)memory - sizeof raw - sizeof taken, sizeof taken);
    assert_int_equal(size, taken);
    books->bytes -= size;
    books->blocks--;
    free(raw);
}

/** An empty scene of two HIPs whose every byte is in the books. */
static inline knurl_scene *scene_with(ledger *books) {
    const knurl_allocator allocator = {take, give_back, books};
    knurl_scene_desc desc;
    knurl_scene *scene = NULL;
    knurl_scene_desc_init(&desc, sizeof desc);
    desc.hip_count = 2;
    desc.allocator = &allocator;
    assert_int_equal(knurl_scene_create(&desc, &scene), KNURL_OK);
    assert_true(knurl_scene_get_bytes(scene) == books->bytes);
    return scene;
}

/** Destroys the scene, of which nothing may be left. */
static inline void end_with(knurl_scene *scene, const ledger *books) {
    knurl_scene_destroy(scene);
    assert_int_equal(books->blocks, 0);
    assert_true(books->bytes == 0);
}

#endif

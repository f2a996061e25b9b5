/* Counted memory: allocations and frees of a heap and a scene, and their behaviour when memory runs out.
 * SPDX-License-Identifier: MIT */
#include "support/close.h"

#include "base/heap.h"

#include <knurl/knurl.h>

#include <stdlib.h>

/* An allocator that keeps accounts and fails on request. */
typedef struct books {
    struct {
        void *memory;
        size_t size;
    } held[1024];
    size_t count, bytes, calls, wrong;
    size_t fail_at; /* the call that fails; 0: no call */
} books;

static void *book_allocate(size_t size, size_t alignment, void *user) {
    books *b = user;
    void *memory = NULL;
    b->wrong += size == 0 || alignment == 0 || (alignment & (alignment - 1)) != 0;
    if (++b->calls == b->fail_at || b->count == COUNT_OF(b->held) ||
        posix_memalign(&memory, alignment < sizeof memory ? sizeof memory : alignment, size) != 0) {
        return NULL;
    }
    memset(memory, 0x5a, size);
    b->held[b->count].memory = memory;
    b->held[b->count++].size = size;
    b->bytes += size;
    return memory;
}

static void book_release(void *memory, size_t size, void *user) {
    books *b = user;
    for (size_t i = 0; i < b->count; i++) {
        if (b->held[i].memory == memory) {
            b->wrong += b->held[i].size != size;
            b->bytes -= b->held[i].size;
            b->held[i] = b->held[--b->count];
            free(memory);
            return;
        }
    }
    b->wrong++;
}

TEST(heap_memory_is_zeroed_aligned_and_counted) {
    static books b;
    const knurl_allocator allocators[] = {{book_allocate, book_release, &b}};
    memset(&b, 0, sizeof b);
    for (int own = 0; own < 2; own++) {
        knurl_heap heap;
        uint64_t expected = 0;
        unsigned char *blocks[20];
        knurl_heap_init(&heap, own ? allocators : NULL);
        for (size_t i = 0; i < COUNT_OF(blocks); i++) {
            blocks[i] = knurl_heap_alloc(&heap, i, 7 * i + 1);
            assert_non_null(blocks[i]);
            assert_int_equal((uintptr_t)blocks[i] % 64, 0);
            for (size_t j = 0; j < i * (7 * i + 1); j++) {
                assert_int_equal(blocks[i][j], 0);
            }
            memset(blocks[i], 0xff, i * (7 * i + 1));
            assert_true(knurl_heap_size(blocks[i]) >= i * (7 * i + 1));
            expected += knurl_heap_size(blocks[i]);
            assert_int_equal(heap.bytes, expected);
            assert_true(!own || b.bytes == heap.bytes);
        }
        for (size_t i = 0; i < COUNT_OF(blocks); i++) { /* in no order: from the middle and the ends */
            void *block = blocks[i * 7 % COUNT_OF(blocks)];
            expected -= knurl_heap_size(block);
            knurl_heap_free(&heap, block);
            assert_int_equal(heap.bytes, expected);
        }
        assert_int_equal(heap.bytes, 0);
        assert_null(heap.first);
    }
    assert_int_equal(b.count, 0);
    assert_int_equal(b.wrong, 0); /* every size was above 0 and came back as it went, every alignment a power of two */
    assert_int_equal(knurl_heap_size(NULL), 0);
}

/* Whether the system grants the lock or not. */
TEST(a_locked_heap_keeps_small_blocks_for_the_next_of_their_size_and_gives_all_back_with_the_last) {
    static books b;
    const knurl_allocator allocator = {book_allocate, book_release, &b};
    knurl_heap heap;
    void *blocks[200];
    memset(&b, 0, sizeof b);
    knurl_heap_init(&heap, &allocator);
    void *last = knurl_heap_alloc(&heap, 1, 8);
    (void)knurl_heap_lock(&heap);
    for (int turn = 0; turn < 100; turn++) { /* as records of a surface that moves come and go */
        char *next = knurl_heap_alloc(&heap, 1, 500);
        assert_non_null(next);
        assert_true(next[0] == 0 && next[499] == 0);
        memset(next, 0x77, 500);
        knurl_heap_free(&heap, next);
    }
    assert_int_equal(b.calls, 2);
    assert_int_equal(b.bytes, heap.bytes);
    knurl_heap_free(&heap, knurl_heap_alloc(&heap, 1, 400));
    assert_int_equal(b.calls, 3); /* another size */
    knurl_heap_free(&heap, knurl_heap_alloc(&heap, 1, 1000000));
    assert_int_equal(b.count, 3); /* large ones go back at once */
    for (size_t i = 0; i < COUNT_OF(blocks); i++) {
        blocks[i] = knurl_heap_alloc(&heap, 1, 500);
    }
    for (size_t i = 0; i < COUNT_OF(blocks); i++) {
        knurl_heap_free(&heap, blocks[i]);
    }
    assert_int_equal(b.count, 1 + 64); /* and so many spares */
    assert_int_equal(b.bytes, heap.bytes);
    knurl_heap_free(&heap, last);
    assert_int_equal(b.count, 0);
    assert_int_equal(b.wrong, 0);
    assert_int_equal(heap.bytes, 0);
}

TEST(freeing_nothing_is_allowed) {
    knurl_heap heap;
    knurl_heap_init(&heap, NULL);
    knurl_heap_free(&heap, NULL);
    assert_int_equal(heap.bytes, 0);
}

TEST(a_size_that_overflows_is_refused_before_the_allocator_sees_it) {
    static books b;
    const knurl_allocator allocator = {book_allocate, book_release, &b};
    const struct {
        uint64_t count;
        size_t size;
    } huge[] = {{UINT64_MAX, 1},   {UINT64_MAX, SIZE_MAX}, {SIZE_MAX, 2},
                {2, SIZE_MAX},     {SIZE_MAX / 8 + 1, 8},  {UINT64_C(1) << 32, SIZE_MAX >> 31},
                {SIZE_MAX - 63, 1}};
    knurl_heap heap;
    memset(&b, 0, sizeof b);
    knurl_heap_init(&heap, &allocator);
    for (size_t i = 0; i < COUNT_OF(huge); i++) {
        (void)knurl_fail(KNURL_ERROR_STATE, "stale message");
        assert_null(knurl_heap_alloc(&heap, huge[i].count, huge[i].size));
        assert_non_null(strstr(knurl_error_message(), "memory"));
    }
    assert_int_equal(b.calls, 0);
    assert_int_equal(heap.bytes, 0);
    knurl_heap_init(&heap, NULL);
    assert_null(knurl_heap_alloc(&heap, (uint64_t)SIZE_MAX - 64, 1)); /* the default one adds a header of its own */
}

static knurl_result build_scene(const knurl_allocator *allocator, knurl_scene **scene) {
    static const float corners[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
    static const uint32_t triangles[] = {0, 1, 2, 2, 1, 3};
    knurl_scene_desc desc;
    knurl_mesh_desc mesh;
    knurl_material_desc material;
    knurl_surface_desc surface;
    knurl_scene_desc_init(&desc, sizeof desc);
    knurl_mesh_desc_init(&mesh, sizeof mesh);
    knurl_material_desc_init(&material, sizeof material);
    knurl_surface_desc_init(&surface, sizeof surface);
    desc.allocator = allocator;
    mesh.vertex_count = 4;
    mesh.positions = corners;
    mesh.indices = triangles;
    mesh.index_count = 6;
    material.stiffness = 400.0;
    surface.mesh = &mesh;
    surface.material = &material;
    surface.name = "square";
    surface.axis[0] = 1.0;
    knurl_result result = knurl_scene_create(&desc, scene);
    for (int i = 0; i < 40 && !result; i++) { /* more than a first block of surfaces */
        result = knurl_scene_add_surface(*scene, &surface, NULL);
    }
    return result ? result : knurl_scene_commit(*scene);
}

TEST(a_scene_takes_all_its_memory_from_its_allocator_and_counts_it) {
    static books b;
    const knurl_allocator allocator = {book_allocate, book_release, &b};
    knurl_scene *scene = NULL;
    memset(&b, 0, sizeof b);
    assert_int_equal(build_scene(&allocator, &scene), KNURL_OK);
    assert_int_equal(knurl_scene_get_bytes(scene), b.bytes);
    assert_true(b.bytes > 0);
    knurl_scene_destroy(scene);
    assert_int_equal(b.count, 0);
    assert_int_equal(b.wrong, 0);
}

TEST(wherever_memory_runs_out_a_scene_says_so_and_leaks_nothing) {
    static books b;
    const knurl_allocator allocator = {book_allocate, book_release, &b};
    knurl_result result = KNURL_ERROR_MEMORY;
    for (size_t fail_at = 1; result; fail_at++) {
        knurl_scene *scene = NULL;
        memset(&b, 0, sizeof b);
        b.fail_at = fail_at;
        result = build_scene(&allocator, &scene);
        assert_int_equal(result, b.calls >= fail_at ? KNURL_ERROR_MEMORY : KNURL_OK);
        knurl_scene_destroy(scene);
        assert_int_equal(b.count, 0);
        assert_int_equal(b.wrong, 0);
    }
    assert_true(b.calls > 3);
}

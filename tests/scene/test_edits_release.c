/* Freeing a large mesh takes milliseconds, counting its edges longer: other threads' edits and questions do not wait.
 * SPDX-License-Identifier: MIT */
#include "contact/mesh.h"
#include "scene/scene.h"

#include "scene/ask.h"
#include "support/ledger.h"

#include "base/system.h"

#include <pthread.h>
#include <time.h>

#define LARGE       20000 /* bytes: only arrays of the mesh are larger */
#define PATIENCE_NS INT64_C(3000000000)

/* An allocator that keeps books, and asks the scene something, on another thread, while a large block is released. */
typedef struct asker {
    ledger books;
    knurl_scene *scene;
    knurl_surface_id id;
    pthread_t thread;
    int is_armed, is_asking; /* on the editing thread; `tell` sets the latter atomically */
    int is_answered;         /* atomic */
    int waited;              /* 1: no answer came while the block was being released */
} asker;

static void *ask(void *argument) {
    asker *a = argument;
    (void)knurl_scene_has_surface(a->scene, a->id);
    __atomic_store_n(&a->is_answered, 1, __ATOMIC_RELEASE);
    return NULL;
}

static void *allocate(size_t size, size_t alignment, void *user) {
    return take(size, alignment, &((asker *)user)->books);
}

static void release(void *memory, size_t size, void *user) {
    asker *a = user;
    if (a->is_armed && !a->is_asking && size > LARGE) {
        a->is_asking = 1;
        assert_int_equal(pthread_create(&a->thread, NULL, ask, a), 0);
        const int64_t end = knurl_system_now_ns() + PATIENCE_NS;
        while (!__atomic_load_n(&a->is_answered, __ATOMIC_ACQUIRE) && knurl_system_now_ns() < end) {}
        a->waited = !__atomic_load_n(&a->is_answered, __ATOMIC_ACQUIRE);
    }
    give_back(memory, size, &a->books);
}

static double hills(double x, double y) {
    return 0.002 * sin(150.0 * x) * cos(130.0 * y);
}

TEST(no_edit_waits_while_a_removed_mesh_is_freed) {
    static const double half[2] = {0.05, 0.04};
    SCOPED_SHAPE sheet = shape_sheet(60, 60, half, hills);
    surface_parts parts = surface_mesh(&sheet);
    asker a = {.scene = NULL};
    const knurl_allocator allocator = {allocate, release, &a};
    knurl_scene_desc desc;
    knurl_scene_desc_init(&desc, sizeof desc);
    desc.allocator = &allocator;
    assert_int_equal(knurl_scene_create(&desc, &a.scene), KNURL_OK);
    a.id = add_surface(a.scene, &parts);
    assert_int_equal(knurl_scene_commit(a.scene), KNURL_OK);
    a.is_armed = 1;
    assert_int_equal(knurl_scene_remove_surface(a.scene, a.id), KNURL_OK);
    a.is_armed = 0;
    assert_true(a.is_asking);
    assert_int_equal(pthread_join(a.thread, NULL), 0);
    assert_false(a.waited);
    knurl_scene_destroy(a.scene);
}

/* Tells about a mesh for the first time: most of the time goes into counting its edges. */
static void *tell(void *argument) {
    asker *a = argument;
    knurl_surface_info info;
    knurl_surface_info_init(&info, sizeof info);
    __atomic_store_n(&a->is_asking, 1, __ATOMIC_RELEASE);
    a->waited = knurl_scene_get_surface_info(a->scene, a->id, &info) != KNURL_OK || info.edges < LARGE;
    __atomic_store_n(&a->is_answered, 1, __ATOMIC_RELEASE);
    return NULL;
}

/* Asks once while another thread counts; *waited: the answer came after the count. */
static int answers_while_counting(int *waited) {
    static const double half[2] = {0.05, 0.04};
    static const struct timespec pause = {0, 4000000};
    SCOPED_SHAPE sheet = shape_sheet(400, 400, half, hills);
    surface_parts parts = surface_mesh(&sheet);
    SCOPED_SCENE *scene = scene_of(&parts);
    asker a = {.scene = scene, .id = knurl_scene_get_surface(scene, 0)};
    assert_int_equal(pthread_create(&a.thread, NULL, tell, &a), 0);
    while (!__atomic_load_n(&a.is_asking, __ATOMIC_ACQUIRE)) {}
    (void)nanosleep(&pause, NULL); /* the count takes 0.05 s or more */
    assert_int_equal(knurl_scene_has_surface(scene, a.id), 1);
    (void)nanosleep(&pause, NULL);
    *waited = __atomic_load_n(&a.is_answered, __ATOMIC_ACQUIRE);
    const knurl_surface_info meanwhile = info_of(scene, a.id);
    assert_int_equal(pthread_join(a.thread, NULL), 0);
    assert_true(meanwhile.bytes == info_of(scene, a.id).bytes);
    return !a.waited;
}

TEST(edits_do_not_wait_while_the_edges_of_a_mesh_are_counted) {
    int waited = 1;
    for (int i = 0; i < 10 && waited; i++) { /* a busy machine may give the count all the time first */
        assert_true(answers_while_counting(&waited));
    }
    assert_false(waited);
}

TEST(a_mesh_without_common_edges_is_counted_once) {
    SCOPED_SHAPE apart = shape_new(6, 6, 0);
    for (uint32_t i = 0; i < 6; i++) { /* two triangles, one over the other */
        shape_set(&apart, i, i % 3 == 1 ? 0.1 : 0.0, i % 3 == 2 ? 0.1 : 0.0, i < 3 ? 0.0 : 0.05);
        apart.indices[i] = i;
    }
    surface_parts parts = surface_along_x(&apart);
    SCOPED_SCENE *scene = scene_of(&parts);
    const knurl_surface_id id = knurl_scene_get_surface(scene, 0);
    knurl_surface_data *surface;
    assert_int_equal(info_of(scene, id).edges, 0);
    assert_int_equal(knurl_scene_lock_surface(scene, id, &surface), KNURL_OK);
    surface->shape.mesh->facets.felt_angle[1] = 77.0;
    knurl_scene_unlock(scene);
    CHECK_SAME(info_of(scene, id).felt_angle[1], 77.0); /* not counted again */
}

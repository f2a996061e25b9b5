/* Creating, filling, committing and destroying a scene, on the game thread. SPDX-License-Identifier: MIT */
#include "scene/scene.h"

#include "base/atomic.h"
#include "base/base.h"
#include "base/rule.h"

#include <stdio.h>
#include <string.h>

void knurl_scene_desc_init(knurl_scene_desc *desc, uint32_t size) {
    const knurl_scene_desc defaults = {.max_surfaces = 4096, .hip_count = 1};
    knurl_desc_write(&defaults, sizeof defaults, desc, size);
}

static knurl_result check_scene_desc(const knurl_scene_desc *d) {
    if (d->max_surfaces < 1 || d->max_surfaces > 1u << 20) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "knurl_scene_desc.max_surfaces: expected 1 to 2^20, found %u",
                          (unsigned)d->max_surfaces);
    }
    if (d->hip_count < 1 || d->hip_count > 8) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "knurl_scene_desc.hip_count: expected 1 to 8, found %u",
                          (unsigned)d->hip_count);
    }
    if (d->allocator && (!d->allocator->allocate || !d->allocator->release)) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "knurl_scene_desc.allocator: expected both functions, found null");
    }
    if (d->full_model > 1) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "knurl_scene_desc.full_model: expected 0 or 1, found %u",
                          (unsigned)d->full_model);
    }
    return KNURL_OK;
}

/* No tick may run any more. */
static void free_scene(knurl_scene *scene) {
    knurl_surfaces_release(&scene->surfaces);
    knurl_broad_phase_release(&scene->broad_phase);
    knurl_epoch_release(&scene->heap, scene->epoch.retired);
    for (uint32_t hip = 0; scene->hips && hip < scene->hip_count; hip++) {
        knurl_heap_free(&scene->heap, scene->hips[hip].effects);
    }
    knurl_heap_free(&scene->heap, scene->hips);
    for (int i = 0; i < 2; i++) {
        knurl_system_mutex_destroy(&scene->mutexes[i]);
    }
    knurl_heap heap = scene->heap; /* outlives the scene, which is its last block */
    heap.lock = NULL;
    knurl_heap_free(&heap, scene);
}

/* Scene tags count from 1 and wrap; 0 is not used, so that no id is 0 and small numbers are invalid ids. */
static uint64_t next_tag(void) {
    static uint64_t made; /* atomic */
    const uint64_t before = __atomic_fetch_add(&made, 1, __ATOMIC_RELAXED);
    return before % KNURL_ID_TAG_MAX + 1;
}

knurl_result knurl_scene_create(const knurl_scene_desc *desc, knurl_scene **scene) {
    KNURL_RULE(GAME, NULL);
    if (KNURL_IS_NULL(scene)) {
        return KNURL_ERROR_ARGUMENT;
    }
    knurl_scene_desc d;
    knurl_scene_desc_init(&d, sizeof d);
    knurl_result result = desc ? knurl_desc_read("knurl_scene_desc", desc, &d, sizeof d) : KNURL_OK;
    result = result ? result : check_scene_desc(&d);
    if (result) {
        return result;
    }
    knurl_heap heap;
    knurl_heap_init(&heap, d.allocator);
    knurl_scene *made = knurl_heap_alloc(&heap, 1, sizeof *made);
    if (!made) {
        return KNURL_ERROR_MEMORY;
    }
    made->handle = KNURL_HANDLE_SCENE;
    made->heap = heap;
    for (int i = 0; i < 2; i++) {
        knurl_system_mutex_init(&made->mutexes[i]);
    }
    made->lock = &made->mutexes[0];
    made->heap.lock = &made->mutexes[1];
    made->full_model = d.full_model ? KNURL_FULL_ALL : 0;
    made->surfaces.heap = &made->heap;
    made->surfaces.limit = d.max_surfaces;
    made->surfaces.tag = next_tag();
    knurl_epoch_init(&made->epoch, &made->heap);
    knurl_broad_phase_init(&made->broad_phase, &made->epoch, &made->surfaces);
    made->hip_count = d.hip_count;
    made->hips = knurl_heap_alloc(&made->heap, d.hip_count, sizeof *made->hips);
    if (!made->hips) {
        free_scene(made);
        return KNURL_ERROR_MEMORY;
    }
    for (uint32_t hip = 0; hip < d.hip_count; hip++) {
        knurl_hip_desc defaults;
        knurl_hip_desc_init(&defaults, sizeof defaults);
        (void)knurl_hip_set_up(&made->hips[hip], &defaults, &knurl_touch, HUGE_VAL, 0.0); /* the defaults are valid */
        made->hips[hip].contacts.test_all = (made->full_model & KNURL_FULL_SEARCH) != 0;
        knurl_epoch_add_pin(&made->epoch, &made->hips[hip].pinned);
    }
    *scene = made;
    return KNURL_OK;
}

/* The owner or the last loop that uses the scene frees it, whichever comes last. */
void knurl_scene_destroy(knurl_scene *scene) {
    KNURL_RULE(END, scene);
    if (!scene || KNURL_BAD_HANDLE(scene, SCENE)) {
        return;
    }
    knurl_handle_clear(&scene->handle); /* also while loops still tick it */
    if (__atomic_fetch_or(&scene->use, KNURL_SCENE_DESTROYED, __ATOMIC_ACQ_REL) == 0) {
        free_scene(scene);
    }
}

int knurl_scene_is_destroyed(const knurl_scene *scene) {
    return (knurl_load_acquire(&scene->use) & KNURL_SCENE_DESTROYED) != 0;
}

void knurl_scene_release_hip(knurl_scene *scene, uint32_t hip) {
    const uint32_t left = __atomic_and_fetch(&scene->use, ~(1u << hip), __ATOMIC_ACQ_REL);
    if (left == KNURL_SCENE_DESTROYED) {
        free_scene(scene);
    }
}

knurl_result knurl_scene_check_hip(const knurl_scene *scene, uint32_t hip) {
    if (hip >= scene->hip_count) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "hip: expected below %u (hip_count), found %u",
                          (unsigned)scene->hip_count, (unsigned)hip);
    }
    return KNURL_OK;
}

knurl_result knurl_scene_claim_hip(knurl_scene *scene, uint32_t hip) {
    const knurl_result result = knurl_scene_check_hip(scene, hip);
    if (result) {
        return result;
    }
    uint32_t use = knurl_load_relaxed(&scene->use);
    do {
        if (use & KNURL_SCENE_DESTROYED) {
            return knurl_fail(KNURL_ERROR_STATE, "scene: expected a scene, found one that was destroyed");
        }
        if (use >> hip & 1) {
            return knurl_fail(KNURL_ERROR_STATE,
                              "scene: HIP %u is in use by another loop; destroy that loop first, or give each its own "
                              "HIP (knurl_scene_desc.hip_count)",
                              (unsigned)hip);
        }
    } while (!__atomic_compare_exchange_n(&scene->use, &use, use | 1u << hip, 0, __ATOMIC_ACQ_REL, __ATOMIC_RELAXED));
    return KNURL_OK;
}

void knurl_scene_lock(const knurl_scene *scene) {
    knurl_system_mutex_lock(scene->lock);
}

void knurl_scene_unlock(const knurl_scene *scene) {
    knurl_epoch *epoch = scene->broad_phase.epoch;
    knurl_heap *heap = epoch->heap;
    knurl_retired *taken = knurl_epoch_take(epoch);
    knurl_system_mutex_unlock(scene->lock);
    knurl_epoch_release(heap, taken);
}

knurl_result knurl_scene_lock_surface(const knurl_scene *scene, knurl_surface_id id, knurl_surface_data **surface) {
    if (KNURL_BAD_HANDLE(scene, SCENE)) {
        return KNURL_ERROR_ARGUMENT;
    }
    knurl_scene_lock(scene);
    *surface = knurl_surfaces_get(&scene->surfaces, id);
    if (!*surface) {
        knurl_scene_unlock(scene);
        return KNURL_ERROR_STALE_ID;
    }
    return KNURL_OK;
}

void knurl_scene_centre(const knurl_scene *scene, double centre[3]) {
    double low[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL};
    double high[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (uint32_t i = 0; i < scene->surfaces.count; i++) {
        const knurl_surface_data *surface = knurl_surfaces_at(&scene->surfaces, i);
        double least[3];
        double greatest[3];
        knurl_surface_bounds(surface, &surface->record->motion, knurl_scene_time(scene), least, greatest);
        for (int axis = 0; axis < 3; axis++) {
            low[axis] = fmin(low[axis], least[axis]);
            high[axis] = fmax(high[axis], greatest[axis]);
        }
    }
    for (int axis = 0; axis < 3; axis++) {
        centre[axis] = scene->surfaces.count > 0 ? 0.5 * (low[axis] + high[axis]) : 0.0;
    }
}

double knurl_scene_time(const knurl_scene *scene) {
    double latest = 0.0;
    for (uint32_t hip = 0; hip < scene->hip_count; hip++) {
        latest = fmax(latest, knurl_load_double(&scene->hips[hip].contacts.clock.time));
    }
    return latest;
}

static knurl_result commit(knurl_scene *scene) {
    if (scene->committed) {
        return knurl_fail(KNURL_ERROR_STATE, "scene: expected one that is not committed yet, found a committed one");
    }
    const knurl_result result =
        knurl_broad_phase_rebuild(&scene->broad_phase, scene->surfaces.capacity > 0 ? scene->surfaces.capacity : 4,
                                  knurl_scene_time(scene)); /* grows with the scene */
    for (uint32_t hip = 0; !result && hip < scene->hip_count; hip++) {
        if (scene->hips[hip].centred) {
            knurl_scene_centre(scene, scene->hips[hip].workspace.origin);
        }
    }
    knurl_store_release(&scene->committed, (uint32_t)(result == KNURL_OK));
    return result;
}

knurl_result knurl_scene_commit(knurl_scene *scene) {
    KNURL_RULE(GAME, scene);
    if (KNURL_BAD_HANDLE(scene, SCENE)) {
        return KNURL_ERROR_ARGUMENT;
    }
    knurl_scene_lock(scene);
    const knurl_result result = commit(scene);
    knurl_scene_unlock(scene);
    return result;
}

uint32_t knurl_scene_get_surface_count(const knurl_scene *scene) {
    KNURL_RULE(NOT_HAPTIC, scene);
    if (KNURL_BAD_HANDLE(scene, SCENE)) {
        return 0;
    }
    knurl_scene_lock(scene);
    const uint32_t count = scene->surfaces.count;
    knurl_scene_unlock(scene);
    return count;
}

knurl_surface_id knurl_scene_get_surface(const knurl_scene *scene, uint32_t index) {
    KNURL_RULE(NOT_HAPTIC, scene);
    if (KNURL_BAD_HANDLE(scene, SCENE)) {
        return 0;
    }
    knurl_scene_lock(scene);
    const knurl_surface_id id = index < scene->surfaces.count ? knurl_surfaces_at(&scene->surfaces, index)->id : 0;
    knurl_scene_unlock(scene);
    return id;
}

/* Finds the first surface of that name, or returns null with the names listed in `known`. */
static const knurl_surface_data *find(const knurl_scene *scene, const char *name, char *known, size_t size) {
    size_t used = 0;
    for (uint32_t i = 0; i < scene->surfaces.count; i++) {
        const knurl_surface_data *candidate = knurl_surfaces_at(&scene->surfaces, i);
        if (strcmp(candidate->name, name) == 0) {
            return candidate;
        }
        const int more = snprintf(known + used, size - used, "%s'%s'", i ? ", " : "", candidate->name);
        used += more > 0 && (size_t)more < size - used ? (size_t)more : 0; /* names that do not fit are left out */
        known[used] = 0;
    }
    return NULL;
}

knurl_result knurl_scene_find_surface(const knurl_scene *scene, const char *name, knurl_surface_id *surface) {
    KNURL_RULE(NOT_HAPTIC, scene);
    if (KNURL_BAD_HANDLE(scene, SCENE) || KNURL_IS_NULL(name) || KNURL_IS_NULL(surface)) {
        return KNURL_ERROR_ARGUMENT;
    }
    char known[512] = "";
    knurl_scene_lock(scene);
    const knurl_surface_data *data = find(scene, name, known, sizeof known);
    const knurl_surface_id id = data ? data->id : 0;
    knurl_scene_unlock(scene);
    if (!id) {
        return knurl_fail(KNURL_ERROR_UNKNOWN, "surface: expected one of %s, found '%s'",
                          known[0] ? known : "(no surface)", name);
    }
    *surface = id;
    return KNURL_OK;
}

void knurl_scene_copy_name(const knurl_surface_data *surface, char name[KNURL_NAME_SIZE]) {
    size_t length = strlen(surface->name);
    if (length >= KNURL_NAME_SIZE) {
        length = KNURL_NAME_SIZE - 1;
        while (length > 0 &&
               ((unsigned char)surface->name[length] & 0xC0u) == 0x80u) { /* within a character of UTF-8 */
            length--;
        }
    }
    memcpy(name, surface->name, length);
    name[length] = 0;
}

knurl_result knurl_scene_get_surface_name(const knurl_scene *scene, knurl_surface_id surface,
                                          char name[KNURL_NAME_SIZE]) {
    KNURL_RULE(NOT_HAPTIC, scene);
    if (KNURL_IS_NULL(name)) {
        return KNURL_ERROR_ARGUMENT;
    }
    knurl_surface_data *data;
    const knurl_result result = knurl_scene_lock_surface(scene, surface, &data);
    if (!result) {
        knurl_scene_copy_name(data, name);
        knurl_scene_unlock(scene);
    }
    return result;
}

uint64_t knurl_scene_get_bytes(const knurl_scene *scene) {
    KNURL_RULE(NOT_HAPTIC, scene);
    if (KNURL_BAD_HANDLE(scene, SCENE)) {
        return 0;
    }
    return knurl_heap_bytes(&scene->heap);
}

knurl_result knurl_scene_lock_memory(knurl_scene *scene) {
    KNURL_RULE(GAME, scene);
    if (KNURL_BAD_HANDLE(scene, SCENE)) {
        return KNURL_ERROR_ARGUMENT;
    }
    return knurl_heap_lock(&scene->heap);
}

/* A scene's life on the game thread: create, surfaces, HIPs, commit. SPDX-License-Identifier: MIT */
#include "scene/scene_internal.h"

#include "base/base.h"

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
    if (d->full_model & ~(uint32_t)KNURL_FULL_ALL) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "knurl_scene_desc.full_model: expected KNURL_FULL_ bits, found %#x",
                          (unsigned)d->full_model);
    }
    return KNURL_OK;
}

knurl_result knurl_scene_create(const knurl_scene_desc *desc, knurl_scene **scene) {
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
    made->epoch = made->version = 1;
    made->full_model = d.full_model;
    made->max_surfaces = d.max_surfaces;
    made->hip_count = d.hip_count;
    made->hips = knurl_heap_alloc(&made->heap, d.hip_count, sizeof *made->hips);
    if (!made->hips) {
        knurl_scene_destroy(made);
        return KNURL_ERROR_MEMORY;
    }
    for (uint32_t hip = 0; hip < d.hip_count; hip++) {
        (void)knurl_scene_configure_hip(made, hip, NULL); /* defaults are in range */
    }
    *scene = made;
    return KNURL_OK;
}

void knurl_scene_destroy(knurl_scene *scene) {
    if (!scene) {
        return;
    }
    for (uint32_t i = 0; i < scene->surface_count; i++) {
        knurl_surface_data *surface = scene->surfaces[scene->order[i]];
        surface->retired.release(&scene->heap, &surface->retired);
    }
    if (scene->world) {
        scene->world->retired.release(&scene->heap, &scene->world->retired);
    }
    while (scene->retired) { /* no tick runs any more */
        knurl_retired *retired = scene->retired;
        scene->retired = retired->next;
        retired->release(&scene->heap, retired);
    }
    void *const arrays[] = {scene->hips, scene->surfaces, scene->generations, scene->order, scene->vacant};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) {
        knurl_heap_free(&scene->heap, arrays[i]);
    }
    for (int i = 0; i < 2; i++) {
        knurl_system_mutex_destroy(&scene->mutexes[i]);
    }
    knurl_handle_clear(&scene->handle);
    knurl_heap heap = scene->heap; /* outlives the scene, which is its last block */
    heap.lock = NULL;
    knurl_heap_free(&heap, scene);
}

void knurl_scene_lock(const knurl_scene *scene) {
    knurl_system_mutex_lock(scene->lock);
}

void knurl_scene_unlock(const knurl_scene *scene) {
    knurl_system_mutex_unlock(scene->lock);
}

knurl_surface_data *knurl_scene_get(const knurl_scene *scene, knurl_surface surface) {
    const uint32_t place = (uint32_t)(surface & UINT32_MAX) - 1; /* 0 wraps to a place that no scene has */
    knurl_surface_data *data = place < scene->capacity ? scene->surfaces[place] : NULL;
    if (!data || data->id != surface) {
        knurl_fail(KNURL_ERROR_STALE_ID, "surface: expected an id of this scene, found %#llx, which names none",
                   (unsigned long long)surface);
        return NULL;
    }
    return data;
}

void knurl_scene_centre(const knurl_scene *scene, double centre[3]) {
    double low[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL};
    double high[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (uint32_t i = 0; i < scene->surface_count; i++) {
        const knurl_surface_data *surface = scene->surfaces[scene->order[i]];
        double least[3];
        double greatest[3];
        knurl_surface_bounds(surface, &surface->record->motion, knurl_scene_time(scene), least, greatest);
        for (int axis = 0; axis < 3; axis++) {
            low[axis] = fmin(low[axis], least[axis]);
            high[axis] = fmax(high[axis], greatest[axis]);
        }
    }
    for (int axis = 0; axis < 3; axis++) {
        centre[axis] = scene->surface_count > 0 ? 0.5 * (low[axis] + high[axis]) : 0.0;
    }
}

double knurl_scene_time(const knurl_scene *scene) {
    double latest = 0.0;
    for (uint32_t hip = 0; hip < scene->hip_count; hip++) {
        double time;
        __atomic_load(&scene->hips[hip].time, &time, __ATOMIC_RELAXED);
        latest = fmax(latest, time);
    }
    return latest;
}

static knurl_result commit(knurl_scene *scene) {
    if (scene->committed) {
        return knurl_fail(KNURL_ERROR_STATE, "scene: expected one that is not committed yet, found a committed one");
    }
    const knurl_result result =
        knurl_world_rebuild(scene, scene->capacity > 0 ? scene->capacity : 4); /* grows with the scene */
    for (uint32_t hip = 0; !result && hip < scene->hip_count; hip++) {
        if (scene->hips[hip].centred) {
            knurl_scene_centre(scene, scene->hips[hip].workspace.origin);
        }
    }
    scene->committed = result == KNURL_OK;
    return result;
}

knurl_result knurl_scene_commit(knurl_scene *scene) {
    knurl_scene_lock(scene);
    const knurl_result result = commit(scene);
    knurl_scene_unlock(scene);
    return result;
}

uint32_t knurl_scene_surface_count(const knurl_scene *scene) {
    knurl_scene_lock(scene);
    const uint32_t count = scene->surface_count;
    knurl_scene_unlock(scene);
    return count;
}

knurl_surface knurl_scene_surface_at(const knurl_scene *scene, uint32_t index) {
    knurl_scene_lock(scene);
    const knurl_surface id = index < scene->surface_count ? scene->surfaces[scene->order[index]]->id : 0;
    knurl_scene_unlock(scene);
    return id;
}

/* The first of that name, or null with the names there are in `known`. */
static const knurl_surface_data *find(const knurl_scene *scene, const char *name, char *known, size_t size) {
    size_t used = 0;
    for (uint32_t i = 0; i < scene->surface_count; i++) {
        const knurl_surface_data *candidate = scene->surfaces[scene->order[i]];
        if (name && strcmp(candidate->name, name) == 0) {
            return candidate;
        }
        const int more = snprintf(known + used, size - used, "%s'%s'", i ? ", " : "", candidate->name);
        used += more > 0 && (size_t)more < size - used ? (size_t)more : 0; /* what does not fit is left out */
        known[used] = 0;
    }
    return NULL;
}

knurl_result knurl_scene_find_surface(const knurl_scene *scene, const char *name, knurl_surface *surface) {
    char known[512] = "";
    knurl_scene_lock(scene);
    const knurl_surface_data *data = find(scene, name, known, sizeof known);
    const knurl_surface id = data ? data->id : 0;
    knurl_scene_unlock(scene);
    if (!id) {
        return knurl_fail(KNURL_ERROR_UNKNOWN, "surface: expected one of %s, found '%s'",
                          known[0] ? known : "(no surface)", name ? name : "(null)");
    }
    *surface = id;
    return KNURL_OK;
}

knurl_result knurl_scene_surface_name(const knurl_scene *scene, knurl_surface surface, const char **name) {
    knurl_scene_lock(scene);
    const knurl_surface_data *data = knurl_scene_get(scene, surface);
    if (data) {
        *name = data->name;
    }
    knurl_scene_unlock(scene);
    return data ? KNURL_OK : KNURL_ERROR_STALE_ID;
}

uint64_t knurl_scene_bytes(const knurl_scene *scene) {
    return knurl_heap_bytes(&scene->heap);
}

knurl_result knurl_scene_lock_memory(knurl_scene *scene) {
    return knurl_heap_lock(&scene->heap);
}

/* Edits, from any thread, before the commit and after: surfaces come and go, move, change how they feel. Whatever can
 * fail comes first; what a tick may see is swapped last. SPDX-License-Identifier: MIT */
#include "scene/scene_internal.h"

#include <string.h>

/* Twice the places, or as many as are allowed: a scene costs what is in it. */
static knurl_result grow(knurl_scene *scene) {
    uint32_t capacity = scene->capacity > 0 ? 2 * scene->capacity : 4;
    capacity = capacity < scene->max_surfaces ? capacity : scene->max_surfaces;
    if (scene->capacity == capacity) {
        return knurl_fail(KNURL_ERROR_FULL, "scene: expected at most %u surfaces (max_surfaces), found one more",
                          (unsigned)scene->max_surfaces);
    }
    void **const arrays[] = {(void **)&scene->surfaces, (void **)&scene->generations, (void **)&scene->order,
                             (void **)&scene->vacant};
    const size_t sizes[] = {sizeof *scene->surfaces, sizeof *scene->generations, sizeof *scene->order,
                            sizeof *scene->vacant};
    void *made[4];
    int failed = 0;
    for (int i = 0; i < 4; i++) {
        made[i] = knurl_heap_alloc(&scene->heap, capacity, sizes[i]);
        failed |= made[i] == NULL;
    }
    for (int i = 0; i < 4; i++) {
        void *old = *arrays[i];
        if (!failed && scene->capacity > 0) {
            memcpy(made[i], old, scene->capacity * sizes[i]);
        }
        knurl_heap_free(&scene->heap, failed ? made[i] : old);
        *arrays[i] = failed ? old : made[i];
    }
    if (failed) {
        return KNURL_ERROR_MEMORY;
    }
    for (uint32_t place = capacity; place-- > scene->capacity;) {
        scene->vacant[scene->vacant_count++] = place;
    }
    scene->capacity = capacity;
    return KNURL_OK;
}

static knurl_result add(knurl_scene *scene, knurl_surface_data *surface) {
    knurl_result result = scene->vacant_count == 0 ? grow(scene) : KNURL_OK;
    if (result) {
        return result;
    }
    surface->place = scene->vacant[scene->vacant_count - 1];
    surface->generation = scene->generations[surface->place];
    surface->id = (uint64_t)surface->generation << 32 | (surface->place + 1);
    scene->surfaces[surface->place] = surface;
    scene->order[scene->surface_count++] = surface->place;
    result = scene->committed ? knurl_world_add(scene, surface) : KNURL_OK;
    if (result) {
        scene->surfaces[surface->place] = NULL;
        scene->surface_count--;
        return result;
    }
    scene->vacant_count--;
    return KNURL_OK;
}

knurl_result knurl_scene_add_surface(knurl_scene *scene, const knurl_surface_desc *desc, knurl_surface *surface) {
    knurl_surface_data *made = NULL;
    knurl_result result =
        knurl_surface_build(&scene->heap, desc, scene->full_model, &made); /* long; without the lock */
    if (result) {
        return result;
    }
    knurl_scene_lock(scene);
    result = add(scene, made);
    const knurl_surface id = result ? 0 : made->id;
    knurl_scene_unlock(scene);
    if (result) {
        made->retired.release(&scene->heap, &made->retired);
    } else if (surface) {
        *surface = id;
    }
    return result;
}

static void remove_surface(knurl_scene *scene, knurl_surface_data *surface) {
    uint32_t at = 0;
    while (scene->order[at] != surface->place) {
        at++;
    }
    scene->surface_count--;
    memmove(&scene->order[at], &scene->order[at + 1], (scene->surface_count - at) * sizeof *scene->order);
    scene->surfaces[surface->place] = NULL;
    scene->generations[surface->place]++;
    scene->vacant[scene->vacant_count++] = surface->place;
    knurl_world_remove(scene, surface);
}

knurl_result knurl_scene_remove_surface(knurl_scene *scene, knurl_surface surface) {
    knurl_scene_lock(scene);
    knurl_surface_data *data = knurl_scene_get(scene, surface);
    if (data) {
        remove_surface(scene, data);
    }
    knurl_scene_unlock(scene);
    return data ? KNURL_OK : KNURL_ERROR_STALE_ID;
}

static knurl_result set_material(knurl_scene *scene, knurl_surface surface, const knurl_material_desc *material) {
    knurl_surface_data *data = knurl_scene_get(scene, surface);
    if (!data) {
        return KNURL_ERROR_STALE_ID;
    }
    knurl_record *record = knurl_record_copy(&scene->heap, data->record);
    if (!record) {
        return KNURL_ERROR_MEMORY;
    }
    const knurl_result result = knurl_record_set_material(record, data, material, scene->full_model);
    if (result) {
        knurl_heap_free(&scene->heap, record);
        return result;
    }
    knurl_world_publish(scene, data, record);
    return KNURL_OK;
}

knurl_result knurl_scene_set_material(knurl_scene *scene, knurl_surface surface, const knurl_material_desc *material) {
    knurl_scene_lock(scene);
    const knurl_result result = set_material(scene, surface, material);
    knurl_scene_unlock(scene);
    return result;
}

static knurl_result set_transform(knurl_scene *scene, knurl_surface surface, const knurl_pose *pose, double seconds) {
    knurl_surface_data *data = knurl_scene_get(scene, surface);
    if (!data) {
        return KNURL_ERROR_STALE_ID;
    }
    knurl_record *record = knurl_record_copy(&scene->heap, data->record);
    if (!record) {
        return KNURL_ERROR_MEMORY;
    }
    if (scene->committed) {
        knurl_motion_go(&record->motion, pose, &data->local, knurl_scene_time(scene), seconds);
        data->moved = 1;
        scene->moves++;
    } else {
        knurl_motion_place(pose, &data->local, &record->motion);
    }
    knurl_world_publish(scene, data, record);
    return KNURL_OK;
}

knurl_result knurl_scene_set_transform(knurl_scene *scene, knurl_surface surface, const double position[3],
                                       const double rotation[4], double seconds) {
    knurl_pose pose;
    knurl_result result = knurl_surface_check_pose(position, rotation, &pose);
    if (!result && !knurl_is_within(seconds, 0.0, 10.0)) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "seconds: expected 0 to 10 s, found %g", seconds);
    }
    if (!result) {
        knurl_scene_lock(scene);
        result = set_transform(scene, surface, &pose, seconds);
        knurl_scene_unlock(scene);
    }
    return result;
}

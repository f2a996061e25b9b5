/* A scene's life on the game thread: create, surfaces, HIPs, commit. SPDX-License-Identifier: MIT */
#include "scene/scene_internal.h"

#include "base/base.h"
#include "base/vec3.h"

#include <stdio.h>
#include <string.h>

void knurl_material_desc_init(knurl_material_desc *desc, uint32_t size) {
    const knurl_material_desc defaults = {.stiffness = 400.0};
    knurl_desc_write(&defaults, sizeof defaults, desc, size);
}

void knurl_surface_desc_init(knurl_surface_desc *desc, uint32_t size) {
    const knurl_surface_desc defaults = {.rotation = {0.0, 0.0, 0.0, 1.0}};
    knurl_desc_write(&defaults, sizeof defaults, desc, size);
}

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
    made->heap = heap;
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
    knurl_heap heap = scene->heap; /* outlives the scene, which is its last block */
    for (uint32_t i = 0; i < scene->surface_count; i++) {
        knurl_surface_release(&heap, &scene->surfaces[scene->order[i]]);
    }
    knurl_heap_free(&heap, scene->hips);
    knurl_heap_free(&heap, scene->order);
    knurl_heap_free(&heap, scene->surfaces);
    knurl_heap_free(&heap, scene);
}

static knurl_surface make_id(const knurl_scene *scene, uint32_t place) {
    return (uint64_t)scene->surfaces[place].generation << 32 | (place + 1);
}

knurl_surface_data *knurl_scene_get(const knurl_scene *scene, knurl_surface surface) {
    const uint32_t place = (uint32_t)(surface & UINT32_MAX) - 1; /* 0 wraps to a place that no scene has */
    if (place >= scene->capacity || !scene->surfaces[place].alive || make_id(scene, place) != surface) {
        knurl_fail(KNURL_ERROR_STALE_ID, "surface: expected an id of this scene, found %#llx, which names none",
                   (unsigned long long)surface);
        return NULL;
    }
    return &scene->surfaces[place];
}

static knurl_result check_open(const knurl_scene *scene, const char *what) {
    if (scene->committed) {
        return knurl_fail(KNURL_ERROR_STATE, "scene: %s is for before the commit, and it is committed", what);
    }
    return KNURL_OK;
}

/* Twice the places, or as many as are allowed: a scene costs what is in it. */
static knurl_result grow(knurl_scene *scene) {
    uint32_t capacity = scene->capacity > 0 ? 2 * scene->capacity : 4;
    capacity = capacity < scene->max_surfaces ? capacity : scene->max_surfaces;
    if (scene->capacity == capacity) {
        return knurl_fail(KNURL_ERROR_FULL, "scene: expected at most %u surfaces (max_surfaces), found one more",
                          (unsigned)scene->max_surfaces);
    }
    knurl_surface_data *surfaces = knurl_heap_alloc(&scene->heap, capacity, sizeof *surfaces);
    uint32_t *order = knurl_heap_alloc(&scene->heap, capacity, sizeof *order);
    if (!surfaces || !order) {
        knurl_heap_free(&scene->heap, surfaces);
        knurl_heap_free(&scene->heap, order);
        return KNURL_ERROR_MEMORY;
    }
    if (scene->capacity > 0) {
        memcpy(surfaces, scene->surfaces, scene->capacity * sizeof *surfaces);
        memcpy(order, scene->order, scene->capacity * sizeof *order);
    }
    knurl_heap_free(&scene->heap, scene->surfaces);
    knurl_heap_free(&scene->heap, scene->order);
    scene->surfaces = surfaces;
    scene->order = order;
    scene->capacity = capacity;
    return KNURL_OK;
}

knurl_result knurl_scene_add_surface(knurl_scene *scene, const knurl_surface_desc *desc, knurl_surface *surface) {
    knurl_result result = check_open(scene, "adding a surface");
    if (result) {
        return result;
    }
    uint32_t place = 0;
    if (scene->surface_count == scene->capacity) {
        place = scene->capacity;
        result = grow(scene);
        if (result) {
            return result;
        }
    }
    while (scene->surfaces[place].alive) {
        place++;
    }
    result = knurl_surface_build(&scene->heap, desc, &scene->surfaces[place]);
    if (!result) {
        scene->order[scene->surface_count++] = place;
        if (surface) {
            *surface = make_id(scene, place);
        }
    }
    return result;
}

knurl_result knurl_scene_remove_surface(knurl_scene *scene, knurl_surface surface) {
    knurl_surface_data *data = knurl_scene_get(scene, surface);
    const knurl_result result = data ? check_open(scene, "removing a surface") : KNURL_ERROR_STALE_ID;
    if (result) {
        return result;
    }
    const uint32_t place = (uint32_t)(data - scene->surfaces);
    knurl_surface_release(&scene->heap, data);
    data->generation++;
    uint32_t kept = 0;
    for (uint32_t i = 0; i < scene->surface_count; i++) {
        if (scene->order[i] != place) {
            scene->order[kept++] = scene->order[i];
        }
    }
    scene->surface_count = kept;
    return KNURL_OK;
}

knurl_result knurl_scene_set_material(knurl_scene *scene, knurl_surface surface, const knurl_material_desc *material) {
    knurl_surface_data *data = knurl_scene_get(scene, surface);
    const knurl_result result = data ? check_open(scene, "setting a material") : KNURL_ERROR_STALE_ID;
    return result ? result : knurl_surface_set_material(data, material);
}

void knurl_scene_centre(const knurl_scene *scene, double centre[3]) {
    for (int axis = 0; axis < 3; axis++) {
        double low = HUGE_VAL;
        double high = -HUGE_VAL;
        for (uint32_t i = 0; i < scene->surface_count; i++) {
            const knurl_surface_data *surface = &scene->surfaces[scene->order[i]];
            low = fmin(low, surface->bounds_min[axis]);
            high = fmax(high, surface->bounds_max[axis]);
        }
        centre[axis] = scene->surface_count > 0 ? 0.5 * (low + high) : 0.0;
    }
}

knurl_result knurl_scene_commit(knurl_scene *scene) {
    const knurl_result result = check_open(scene, "committing");
    if (!result) {
        for (uint32_t hip = 0; hip < scene->hip_count; hip++) {
            if (scene->hips[hip].centred) {
                knurl_scene_centre(scene, scene->hips[hip].workspace.origin);
            }
        }
        scene->committed = 1;
    }
    return result;
}

uint32_t knurl_scene_surface_count(const knurl_scene *scene) {
    return scene->surface_count;
}

knurl_surface knurl_scene_surface_at(const knurl_scene *scene, uint32_t index) {
    return index < scene->surface_count ? make_id(scene, scene->order[index]) : 0;
}

knurl_result knurl_scene_find_surface(const knurl_scene *scene, const char *name, knurl_surface *surface) {
    char known[512] = "";
    size_t used = 0;
    for (uint32_t i = 0; i < scene->surface_count; i++) {
        const char *candidate = scene->surfaces[scene->order[i]].name;
        if (name && strcmp(candidate, name) == 0) {
            *surface = make_id(scene, scene->order[i]);
            return KNURL_OK;
        }
        const int more = snprintf(known + used, sizeof known - used, "%s'%s'", i ? ", " : "", candidate);
        used += more > 0 && (size_t)more < sizeof known - used ? (size_t)more : 0; /* what does not fit is left out */
        known[used] = 0;
    }
    return knurl_fail(KNURL_ERROR_UNKNOWN, "surface: expected one of %s, found '%s'", used ? known : "(no surface)",
                      name ? name : "(null)");
}

knurl_result knurl_scene_surface_name(const knurl_scene *scene, knurl_surface surface, const char **name) {
    const knurl_surface_data *data = knurl_scene_get(scene, surface);
    if (data) {
        *name = data->name;
    }
    return data ? KNURL_OK : KNURL_ERROR_STALE_ID;
}

uint64_t knurl_scene_bytes(const knurl_scene *scene) {
    return scene->heap.bytes;
}

knurl_result knurl_scene_lock_memory(knurl_scene *scene) {
    return knurl_heap_lock(&scene->heap);
}

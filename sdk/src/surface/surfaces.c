/* Places and ids of a scene's surfaces. SPDX-License-Identifier: MIT */
#include "surface/surfaces.h"

#include <string.h>

/* Doubles the places, up to the limit: the memory of a scene follows its contents. */
static knurl_result grow(knurl_surfaces *s) {
    uint32_t capacity = s->capacity > 0 ? 2 * s->capacity : 4;
    capacity = capacity < s->limit ? capacity : s->limit;
    if (s->capacity == capacity) {
        return knurl_fail(KNURL_ERROR_FULL, "scene: expected at most %u surfaces (max_surfaces), found one more",
                          (unsigned)s->limit);
    }
    void **const arrays[] = {(void **)&s->items, (void **)&s->generations, (void **)&s->order, (void **)&s->vacant};
    const size_t sizes[] = {sizeof *s->items, sizeof *s->generations, sizeof *s->order, sizeof *s->vacant};
    void *made[4];
    int failed = 0;
    for (int i = 0; i < 4; i++) {
        made[i] = knurl_heap_alloc(s->heap, capacity, sizes[i]);
        failed |= made[i] == NULL;
    }
    for (int i = 0; i < 4; i++) {
        void *old = *arrays[i];
        if (!failed && s->capacity > 0) {
            memcpy(made[i], old, s->capacity * sizes[i]);
        }
        knurl_heap_free(s->heap, failed ? made[i] : old);
        *arrays[i] = failed ? old : made[i];
    }
    if (failed) {
        return KNURL_ERROR_MEMORY;
    }
    for (uint32_t place = capacity; place-- > s->capacity;) {
        s->vacant[s->vacant_count++] = place;
    }
    s->capacity = capacity;
    return KNURL_OK;
}

knurl_result knurl_surfaces_add(knurl_surfaces *s, knurl_surface_data *surface) {
    const knurl_result result = s->vacant_count == 0 ? grow(s) : KNURL_OK;
    if (result) {
        return result;
    }
    surface->place = s->vacant[--s->vacant_count];
    surface->generation = s->generations[surface->place];
    surface->id = knurl_surfaces_make_id(s, surface->place, surface->generation);
    s->items[surface->place] = surface;
    s->order[s->count++] = surface->place;
    return KNURL_OK;
}

void knurl_surfaces_undo_add(knurl_surfaces *s, knurl_surface_data *surface) {
    s->items[surface->place] = NULL;
    s->vacant[s->vacant_count++] = surface->place;
    s->count--;
}

void knurl_surfaces_remove(knurl_surfaces *s, knurl_surface_data *surface) {
    uint32_t at = s->count - 1; /* from the end: a failed load removes the last added first */
    while (s->order[at] != surface->place) {
        at--;
    }
    s->count--;
    memmove(&s->order[at], &s->order[at + 1], (s->count - at) * sizeof *s->order);
    s->items[surface->place] = NULL;
    s->generations[surface->place] = (surface->generation + 1) & KNURL_ID_GENERATION_MAX;
    s->vacant[s->vacant_count++] = surface->place;
}

void knurl_surfaces_replace(knurl_surfaces *s, const knurl_surface_data *old, knurl_surface_data *made) {
    made->place = old->place;
    made->generation = old->generation;
    made->id = old->id;
    s->items[old->place] = made;
}

knurl_surface_data *knurl_surfaces_find(const knurl_surfaces *s, knurl_surface_id id) {
    const uint32_t place = (uint32_t)(id & KNURL_ID_PLACE_MAX) - 1; /* 0 wraps to a place above every capacity */
    knurl_surface_data *surface = place < s->capacity ? s->items[place] : NULL;
    return surface && surface->id == id ? surface : NULL;
}

knurl_surface_data *knurl_surfaces_get(const knurl_surfaces *s, knurl_surface_id id) {
    knurl_surface_data *surface = knurl_surfaces_find(s, id);
    if (surface) {
        return surface;
    }
    const uint64_t tag = id >> KNURL_ID_TAG_AT & KNURL_ID_TAG_MAX;
    knurl_fail(KNURL_ERROR_STALE_ID, "surface: expected an id of this scene, found %#llx, which %s",
               (unsigned long long)id,
               tag == 0        ? "names no surface"
               : tag != s->tag ? "is another scene's"
                               : "names a surface that is gone");
    return NULL;
}

void knurl_surfaces_release(knurl_surfaces *s) {
    for (uint32_t i = 0; i < s->count; i++) {
        knurl_surface_data *surface = knurl_surfaces_at(s, i);
        surface->retired.release(s->heap, &surface->retired);
    }
    void *const arrays[] = {s->items, s->generations, s->order, s->vacant};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) {
        knurl_heap_free(s->heap, arrays[i]);
    }
}

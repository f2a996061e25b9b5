/* All surfaces of a scene by place, by id, and in the order of adding. Used by edits, under their lock.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_SURFACES_H
#define KNURL_SRC_SURFACES_H

#include "surface/surface.h"

/* A surface's id, from its lowest bit on: place + 1 in 21 bits (max_surfaces is at most 2^20), the scene's tag in 20,
 * the place's generation in 23. Tags come again after 2^20 - 1 scenes of a process, generations after 2^23 surfaces at
 * one place: an id would have to be kept through all of them, and used just then, to name another surface than it did.
 */
#define KNURL_ID_PLACE_MAX      ((UINT64_C(1) << 21) - 1)
#define KNURL_ID_TAG_MAX        ((UINT64_C(1) << 20) - 1)
#define KNURL_ID_GENERATION_MAX ((1u << 23) - 1)
#define KNURL_ID_TAG_AT         21
#define KNURL_ID_GENERATION_AT  41

/* Zeroed but for heap, limit and tag: empty. */
typedef struct knurl_surfaces {
    knurl_heap *heap;
    knurl_surface_data **items; /* by place; null: free */
    uint32_t *generations;      /* by place */
    uint32_t *order;            /* places, in the order of adding */
    uint32_t *vacant;           /* places that are free, the next one last */
    uint32_t count;
    uint32_t vacant_count;
    uint32_t capacity; /* of the four arrays; grows up to `limit` */
    uint32_t limit;
    uint64_t tag; /* 1 to KNURL_ID_TAG_MAX: of this scene, and of no other */
} knurl_surfaces;

static inline knurl_surface_id knurl_surfaces_make_id(const knurl_surfaces *surfaces, uint32_t place,
                                                      uint32_t generation) {
    return (uint64_t)generation << KNURL_ID_GENERATION_AT | surfaces->tag << KNURL_ID_TAG_AT | (place + 1);
}

/* Gives a surface its place and id. Errors: KNURL_ERROR_FULL, KNURL_ERROR_MEMORY. */
knurl_result knurl_surfaces_add(knurl_surfaces *surfaces, knurl_surface_data *surface);

/* Undoes the latest knurl_surfaces_add(), whose id was not handed out. */
void knurl_surfaces_undo_add(knurl_surfaces *surfaces, knurl_surface_data *surface);

/* Makes its id stale; the caller still releases the surface. */
void knurl_surfaces_remove(knurl_surfaces *surfaces, knurl_surface_data *surface);

/* Puts `made` in the place of `old`, under its id; the caller releases `old`. */
void knurl_surfaces_replace(knurl_surfaces *surfaces, const knurl_surface_data *old, knurl_surface_data *made);

/* The surface of an id, or null. */
knurl_surface_data *knurl_surfaces_find(const knurl_surfaces *surfaces, knurl_surface_id id);

/* The same, with an error where there is none. */
knurl_surface_data *knurl_surfaces_get(const knurl_surfaces *surfaces, knurl_surface_id id);

/* Releases the surfaces and the arrays. */
void knurl_surfaces_release(knurl_surfaces *surfaces);

/* The i-th in the order of adding. */
static inline knurl_surface_data *knurl_surfaces_at(const knurl_surfaces *surfaces, uint32_t i) {
    return surfaces->items[surfaces->order[i]];
}

#endif

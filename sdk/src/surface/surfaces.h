/* All surfaces of a scene by place, by id, and in the order of adding. Used by edits, under the scene's lock.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_SURFACES_H
#define KNURL_SRC_SURFACES_H

#include "surface/surface.h"

/* A surface's id, from its lowest bit on: place + 1 in 21 bits (max_surfaces is at most 2^20), the scene's tag in 20,
 * the place's generation in 23. Tags repeat after 2^20 - 1 scenes of a process, generations after 2^23 surfaces at one
 * place; a stale id names another surface only if it was kept through all of them. */
#define KNURL_ID_PLACE_MAX      ((UINT64_C(1) << 21) - 1)
#define KNURL_ID_TAG_MAX        ((UINT64_C(1) << 20) - 1)
#define KNURL_ID_GENERATION_MAX ((1u << 23) - 1)
#define KNURL_ID_TAG_AT         21
#define KNURL_ID_GENERATION_AT  41

/* Empty if all members but heap, limit and tag are zero. */
typedef struct knurl_surfaces {
    knurl_heap *heap;
    knurl_surface_data **items; /* by place; null: free */
    uint32_t *generations;      /* by place */
    uint32_t *order;            /* places, in the order of adding */
    uint32_t *vacant;           /* free places; the last one is used next */
    uint32_t count;
    uint32_t vacant_count;
    uint32_t capacity; /* of the four arrays; grows up to `limit` */
    uint32_t limit;
    uint64_t tag; /* 1 to KNURL_ID_TAG_MAX: unique to this scene */
} knurl_surfaces;

static inline knurl_surface_id knurl_surfaces_make_id(const knurl_surfaces *surfaces, uint32_t place,
                                                      uint32_t generation) {
    return (uint64_t)generation << KNURL_ID_GENERATION_AT | surfaces->tag << KNURL_ID_TAG_AT | (place + 1);
}

/* Gives a surface its place and id. Errors: KNURL_ERROR_FULL, KNURL_ERROR_MEMORY. */
knurl_result knurl_surfaces_add(knurl_surfaces *surfaces, knurl_surface_data *surface);

/* Undoes the last knurl_surfaces_add(), if its id was not handed out. */
void knurl_surfaces_undo_add(knurl_surfaces *surfaces, knurl_surface_data *surface);

/* Makes its id stale; the caller releases the surface. */
void knurl_surfaces_remove(knurl_surfaces *surfaces, knurl_surface_data *surface);

/* Puts `made` in the place of `old`, under its id; the caller releases `old`. */
void knurl_surfaces_replace(knurl_surfaces *surfaces, const knurl_surface_data *old, knurl_surface_data *made);

/* The surface of an id, or null. */
knurl_surface_data *knurl_surfaces_find(const knurl_surfaces *surfaces, knurl_surface_id id);

/* The same; sets an error if there is no such surface. */
knurl_surface_data *knurl_surfaces_get(const knurl_surfaces *surfaces, knurl_surface_id id);

/* Releases the surfaces and the arrays. */
void knurl_surfaces_release(knurl_surfaces *surfaces);

/* Surface i in the order of adding. */
static inline knurl_surface_data *knurl_surfaces_at(const knurl_surfaces *surfaces, uint32_t i) {
    return surfaces->items[surfaces->order[i]];
}

#endif

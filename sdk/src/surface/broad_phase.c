/* The broad phase. A hierarchy holds the surfaces that were at rest when it was built. Surfaces that moved or were
 * added since are dynamic: a list beside the hierarchy, with a box around every few of them, until it is long enough
 * for a rebuild. Boxes of dynamic surfaces have a margin, so that most moves leave the ticks' lists valid.
 *
 * Ticks read while an edit writes. The order of writes keeps that safe: a box and its group's only grow during a move,
 * and shrink when the move is published; a surface is added to the list before anything relies on it; the version is
 * incremented last, so that a tick that read a half-finished state queries again. SPDX-License-Identifier: MIT */
#include "surface/broad_phase.h"

#include "base/atomic.h"
#include "contact/bvh_search.h"

#include <string.h>

/* Surfaces per leaf. */
#define LEAF_SIZE 2

/* Margin (m) of dynamic surfaces around the box that they sweep now: a constant, and their movement in ROOM_SECONDS at
 * their speed, up to ROOM_MAX. With it a moving surface invalidates lists a few times a second, not every frame. */
#define ROOM         0.005
#define ROOM_SECONDS 0.1
#define ROOM_MAX     0.05

/* Up to this many dynamic surfaces never cause a rebuild: testing one costs a few ns, only when lists are made. */
#define DYNAMIC_MIN 32

static void add_box(const float box[6], float to[6]) {
    for (int i = 0; i < 3; i++) {
        to[i] = box[i] < to[i] ? box[i] : to[i];
        to[3 + i] = box[3 + i] > to[3 + i] ? box[3 + i] : to[3 + i];
    }
}

static void store_box(float to[6], const float box[6]) {
    for (int i = 0; i < 6; i++) {
        knurl_store_float(&to[i], box[i]);
    }
}

static void release(knurl_heap *heap, knurl_retired *retired) {
    knurl_broad_index *index = (knurl_broad_index *)(void *)retired; /* its first member */
    if (index) {
        knurl_heap_free(heap, index->items);
        knurl_heap_free(heap, index->boxes);
        knurl_heap_free(heap, index->dynamic);
        knurl_heap_free(heap, index->order);
        knurl_heap_free(heap, index->nodes);
        knurl_heap_free(heap, index->groups);
        knurl_heap_free(heap, index->rank);
        knurl_heap_free(heap, index);
    }
}

static knurl_broad_index *create(knurl_heap *heap, uint32_t capacity) {
    knurl_broad_index *index = knurl_heap_alloc(heap, 1, sizeof *index);
    if (!index) {
        return NULL;
    }
    index->retired.release = release;
    index->capacity = capacity;
    index->items = knurl_heap_alloc(heap, capacity, sizeof *index->items);
    index->boxes = knurl_heap_alloc(heap, capacity, sizeof *index->boxes);
    index->dynamic = knurl_heap_alloc(heap, capacity, sizeof *index->dynamic);
    index->order = knurl_heap_alloc(heap, capacity, sizeof *index->order);
    index->groups = knurl_heap_alloc(heap, (uint64_t)capacity / KNURL_DYNAMIC_GROUP + 1, sizeof *index->groups);
    index->rank = knurl_heap_alloc(heap, capacity, sizeof *index->rank);
    if (!index->items || !index->boxes || !index->dynamic || !index->order || !index->groups || !index->rank) {
        release(heap, &index->retired);
        return NULL;
    }
    return index;
}

/* Builds the hierarchy of the surfaces at rest. `still`: their places, count of them (> 0). */
static knurl_result build_hierarchy(knurl_heap *heap, knurl_broad_index *index, uint32_t *still, uint32_t count) {
    knurl_box *boxes = knurl_heap_alloc(heap, count, sizeof *boxes);
    uint32_t *order = knurl_heap_alloc(heap, count, sizeof *order);
    knurl_result result = boxes && order ? KNURL_OK : KNURL_ERROR_MEMORY;
    for (uint32_t i = 0; !result && i < count; i++) {
        const float *box = index->boxes[still[i]];
        boxes[i] = (knurl_box){{box[0], box[1], box[2]}, {box[3], box[4], box[5]}};
    }
    result = result ? result : knurl_bvh_build(heap, boxes, count, LEAF_SIZE, order, &index->nodes, &index->node_count);
    for (uint32_t i = 0; !result && i < count; i++) {
        index->order[i] = still[order[i]];
    }
    knurl_heap_free(heap, boxes);
    knurl_heap_free(heap, order);
    return result;
}

static double margin_of(const knurl_motion *motion) {
    const double way = motion->end_time > motion->start_time ? vec3_length(motion->velocity) * ROOM_SECONDS : 0.0;
    return fmin(ROOM + way, ROOM_MAX);
}

/* Sets the box of the group that holds this rank, from the boxes of its surfaces. count: of all dynamic surfaces. */
static void bound_group(knurl_broad_index *index, uint32_t rank, uint32_t count) {
    const uint32_t group = (rank - 1) / KNURL_DYNAMIC_GROUP;
    const uint32_t first = group * KNURL_DYNAMIC_GROUP;
    float box[6];
    memcpy(box, index->boxes[index->dynamic[first]], sizeof box);
    for (uint32_t i = first + 1; i < count && i < first + KNURL_DYNAMIC_GROUP; i++) {
        add_box(index->boxes[index->dynamic[i]], box);
    }
    store_box(index->groups[group], box);
}

static void set_box(knurl_broad_index *index, uint32_t place, const float box[6]) {
    store_box(index->boxes[place], box);
    if (index->rank[place]) {
        bound_group(index, index->rank[place], index->dynamic_count);
    }
}

static void make_dynamic(knurl_broad_index *index, uint32_t place) {
    const uint32_t rank = index->dynamic_count + 1;
    if (!index->rank[place]) {
        knurl_store_relaxed(&index->rank[place], rank);
        index->dynamic[rank - 1] = place;
        bound_group(index, rank, rank);
        knurl_store_release(&index->dynamic_count, rank);
    }
}

void knurl_broad_phase_init(knurl_broad_phase *phase, knurl_epoch *epoch, const knurl_surfaces *surfaces) {
    phase->index = NULL;
    phase->version = 1;
    phase->epoch = epoch;
    phase->surfaces = surfaces;
    phase->moves = 0;
}

void knurl_broad_phase_release(knurl_broad_phase *phase) {
    release(phase->epoch->heap, phase->index ? &phase->index->retired : NULL);
    phase->index = NULL;
}

static void new_version(knurl_broad_phase *phase) {
    knurl_store_release(&phase->version, phase->version + 1);
}

knurl_result knurl_broad_phase_rebuild(knurl_broad_phase *phase, uint32_t capacity, double time) {
    knurl_heap *heap = phase->epoch->heap;
    const knurl_surfaces *surfaces = phase->surfaces;
    uint32_t *still = knurl_heap_alloc(heap, (uint64_t)surfaces->count + 1, sizeof *still);
    knurl_broad_index *index = still ? create(heap, capacity) : NULL;
    uint32_t still_count = 0;
    for (uint32_t i = 0; index && i < surfaces->count; i++) {
        knurl_surface_data *surface = knurl_surfaces_at(surfaces, i);
        index->items[surface->place] = surface;
        knurl_surface_box(surface, surface->record, time, 0.0, index->boxes[surface->place]);
        add_box(surface->record->arrived, index->boxes[surface->place]);
        if (surface->moved) {
            make_dynamic(index, surface->place);
        } else {
            still[still_count++] = surface->place;
        }
    }
    if (!index || (still_count > 0 && build_hierarchy(heap, index, still, still_count) != KNURL_OK)) {
        release(heap, index ? &index->retired : NULL);
        knurl_heap_free(heap, still);
        return KNURL_ERROR_MEMORY;
    }
    knurl_heap_free(heap, still);
    for (uint32_t i = 0; i < surfaces->count; i++) {
        knurl_surfaces_at(surfaces, i)->moved = 0;
    }
    phase->moves = 0;
    knurl_broad_index *old = __atomic_exchange_n(&phase->index, index, __ATOMIC_SEQ_CST);
    new_version(phase);
    if (old) {
        knurl_epoch_retire(phase->epoch, &old->retired);
    }
    return KNURL_OK;
}

/* 1 if there are enough dynamic surfaces for a rebuild. */
static int has_many_dynamic(const knurl_broad_phase *phase) {
    return phase->index->dynamic_count > DYNAMIC_MIN + phase->surfaces->count / 4;
}

/* 1 if a rebuild pays off: it costs about as much as the moves since the last one did. */
static int is_worth_it(const knurl_broad_phase *phase) {
    return has_many_dynamic(phase) && phase->moves > 8 * (uint64_t)phase->index->dynamic_count;
}

knurl_result knurl_broad_phase_add(knurl_broad_phase *phase, knurl_surface_data *surface, double time) {
    knurl_broad_index *index = phase->index;
    const uint32_t capacity = index ? index->capacity : 0;
    if (surface->place >= capacity || has_many_dynamic(phase)) {
        const knurl_surfaces *surfaces = phase->surfaces;
        const uint32_t larger = surfaces->count + surfaces->count / 2 + DYNAMIC_MIN;
        return knurl_broad_phase_rebuild(phase, larger > surfaces->capacity ? larger : surfaces->capacity, time);
    }
    set_box(index, surface->place, surface->record->arrived);
    make_dynamic(index, surface->place);
    __atomic_store_n(&index->items[surface->place], surface, __ATOMIC_SEQ_CST);
    new_version(phase);
    return KNURL_OK;
}

static int holds(const float outer[6], const float inner[6]) {
    return outer[0] <= inner[0] && outer[1] <= inner[1] && outer[2] <= inner[2] && outer[3] >= inner[3] &&
           outer[4] >= inner[4] && outer[5] >= inner[5];
}

/* Lists were made from the stored box and, once a motion was over, from the arrival box. They stay valid while the new
 * motion stays within the latter. */
void knurl_broad_phase_publish(knurl_broad_phase *phase, knurl_surface_data *surface, knurl_record *record,
                               double time) {
    knurl_broad_index *index = phase->index;
    float swept[6];
    knurl_surface_set_boxes(surface, record);
    memcpy(swept, knurl_record_box(record, time), sizeof swept);
    const int stays = index && holds(record->arrived, swept); /* still that of the old record */
    if (!stays) {
        knurl_surface_set_arrival(surface, record, index ? margin_of(&record->motion) : 0.0);
        add_box(record->arrived, swept);
    }
    if (!stays && index) {
        float both[6];
        memcpy(both, swept, sizeof both);
        add_box(index->boxes[surface->place], both);
        set_box(index, surface->place, both);
        make_dynamic(index, surface->place);
        new_version(phase);
    }
    knurl_record *old = __atomic_exchange_n(&surface->record, record, __ATOMIC_SEQ_CST);
    if (!stays && index) { /* lists made meanwhile only hold too many surfaces */
        set_box(index, surface->place, swept);
        new_version(phase);
    }
    knurl_epoch_retire(phase->epoch, &old->retired);
    if (index && is_worth_it(phase)) {
        (void)knurl_broad_phase_rebuild(phase, index->capacity, time); /* if out of memory, keep the old index */
    }
}

void knurl_broad_phase_replace(knurl_broad_phase *phase, knurl_surface_data *old, knurl_surface_data *made) {
    knurl_broad_index *index = phase->index;
    if (index) {
        float both[6];
        memcpy(both, index->boxes[made->place], sizeof both);
        add_box(made->record->arrived, both);
        set_box(index, made->place, both);
        make_dynamic(index, made->place);
        new_version(phase);
        __atomic_store_n(&index->items[made->place], made, __ATOMIC_SEQ_CST);
        set_box(index, made->place, made->record->arrived);
        new_version(phase);
    }
    knurl_epoch_retire(phase->epoch, &old->retired);
}

void knurl_broad_phase_remove(knurl_broad_phase *phase, knurl_surface_data *surface) {
    if (phase->index) {
        __atomic_store_n(&phase->index->items[surface->place], NULL, __ATOMIC_SEQ_CST);
        new_version(phase);
    }
    knurl_epoch_retire(phase->epoch, &surface->retired);
}

static inline int meets(const float *box, const knurl_broad_query *query) {
    for (int i = 0; i < 3; i++) {
        float least;
        float greatest;
        __atomic_load(&box[i], &least, __ATOMIC_RELAXED);
        __atomic_load(&box[3 + i], &greatest, __ATOMIC_RELAXED);
        if (query->high[i] < (double)least || query->low[i] > (double)greatest) {
            return 0;
        }
    }
    return 1;
}

/* The stored box bounds the whole motion; after arrival, or in an exact query, a smaller box counts. */
static int is_there_now(const knurl_broad_index *index, uint32_t place, const knurl_broad_query *query) {
    const knurl_surface_data *surface = __atomic_load_n(&index->items[place], __ATOMIC_SEQ_CST);
    if (!surface || !knurl_load_relaxed(&index->rank[place])) {
        return surface != NULL; /* a surface at rest fills its box */
    }
    const knurl_record *record = __atomic_load_n(&surface->record, __ATOMIC_SEQ_CST);
    if (query->exact) {
        return meets(knurl_record_box(record, query->time), query);
    }
    return !knurl_motion_is_over(&record->motion, query->time) || meets(record->arrived, query);
}

static inline int is_there(const knurl_broad_index *index, uint32_t place, const knurl_broad_query *query) {
    return meets(index->boxes[place], query) && is_there_now(index, place, query);
}

static uint32_t note(uint32_t place, uint32_t limit, uint32_t count, uint32_t *places) {
    if (count < limit) {
        places[count] = place;
    }
    return count + 1;
}

/* A place may be found twice, as dynamic and in the hierarchy. */
static int is_noted(const knurl_broad_index *index, uint32_t place, uint32_t limit, uint32_t count,
                    const uint32_t *places) {
    int noted = 0;
    if (!knurl_load_relaxed(&index->rank[place])) {
        return 0;
    }
    for (uint32_t i = 0; i < count && i < limit; i++) {
        noted |= places[i] == place;
    }
    return noted;
}

static uint32_t find_still(const knurl_broad_index *index, const knurl_broad_query *query, uint32_t limit,
                           uint32_t count, uint32_t *places) {
    uint32_t stack[KNURL_BVH_DEPTH_MAX];
    uint32_t top = 0;
    knurl_search_box box; /* rounded outwards: is_there() compares exactly */
    knurl_search_box_set(query->low, query->high, &box);
    if (index->node_count > 0) {
        stack[top++] = 0;
    }
    while (top > 0 && count <= limit) {
        const uint32_t at = stack[--top];
        const knurl_bvh_node *node = &index->nodes[at];
        if (!knurl_search_box_meets_node(&box, node)) {
            continue;
        }
        for (uint32_t i = 0; i < node->count && count <= limit; i++) {
            const uint32_t place = index->order[node->first + i];
            if (is_there(index, place, query) && /* it may have moved away since */
                !is_noted(index, place, limit, count, places)) {
                count = note(place, limit, count, places);
            }
        }
        if (node->count == 0) {
            stack[top++] = node->first;
            stack[top++] = at + 1;
        }
    }
    return count;
}

uint32_t knurl_broad_phase_find(const knurl_broad_index *index, const knurl_broad_query *query, uint32_t limit,
                                uint32_t *places) {
    uint32_t count = 0;
    if (query->test_all) {
        for (uint32_t place = 0; place < index->capacity && count <= limit; place++) {
            if (is_there(index, place, query)) {
                count = note(place, limit, count, places);
            }
        }
        return count;
    }
    const uint32_t dynamic = knurl_load_acquire(&index->dynamic_count);
    for (uint32_t first = 0; first < dynamic && count <= limit; first += KNURL_DYNAMIC_GROUP) {
        const uint32_t end = dynamic - first < KNURL_DYNAMIC_GROUP ? dynamic : first + KNURL_DYNAMIC_GROUP;
        const int is_near = meets(index->groups[first / KNURL_DYNAMIC_GROUP], query);
        for (uint32_t i = first; is_near && i < end && count <= limit; i++) {
            if (is_there(index, index->dynamic[i], query)) {
                count = note(index->dynamic[i], limit, count, places);
            }
        }
    }
    return find_still(index, query, limit, count, places);
}

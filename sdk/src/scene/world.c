/* Where all surfaces are. A hierarchy holds those that stood still when it was built; what has moved or come since is
 * loose, in a list beside it, until there is enough of it to build anew. Boxes of loose surfaces are larger than they
 * need be, so that most moves change nothing that a tick looks up.
 *
 * Ticks read while an edit writes. What keeps that right: a box only grows while a move is on its way, and shrinks when
 * the move is published; a name is added to the list before anything relies on it; and the scene's version is counted
 * up after, so that a tick that saw half of it looks again. SPDX-License-Identifier: MIT */
#include "scene/scene_internal.h"

#include "base/atomic.h"

#include <string.h>

/* Surfaces in a leaf. */
#define LEAF_SIZE 2

/* Loose surfaces get this much room (m) beside what they sweep now, and what they would sweep in as many seconds at
 * their speed, up to a bound: so that a moving surface asks for new lists a few times a second, not every frame. */
#define ROOM         0.005
#define ROOM_SECONDS 0.1
#define ROOM_MAX     0.05

/* Loose surfaces that are let be before they are built in: looking at one costs a few ns when lists are made. */
#define LOOSE_MIN 32

/* Farther than any scene goes; sums of such numbers are still floats. */
#define FAR_AWAY 1e30

static float round_down(double value) {
    const double near = fmin(fmax(value, -FAR_AWAY), FAR_AWAY);
    const float f = (float)near;
    return (double)f > near ? nextafterf(f, -HUGE_VALF) : f;
}

static float round_up(double value) {
    return -round_down(-value);
}

/* The box of all that a motion sweeps from `now` on, with the crests and `room` round it. */
static void make_box(const knurl_surface_data *surface, const knurl_record *record, double now, double room,
                     float box[6]) {
    double low[3];
    double high[3];
    knurl_surface_bounds(surface, &record->motion, now, low, high);
    for (int i = 0; i < 3; i++) {
        box[i] = round_down(low[i] - record->reach - room);
        box[3 + i] = round_up(high[i] + record->reach + room);
    }
}

void knurl_record_set_box(const knurl_surface_data *surface, knurl_record *record, double room) {
    make_box(surface, record, HUGE_VAL, room, record->arrived);
}

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
    knurl_world *world = (knurl_world *)(void *)retired; /* its first member */
    if (world) {
        knurl_heap_free(heap, world->items);
        knurl_heap_free(heap, world->boxes);
        knurl_heap_free(heap, world->loose);
        knurl_heap_free(heap, world->order);
        knurl_heap_free(heap, world->nodes);
        knurl_heap_free(heap, world->is_loose);
        knurl_heap_free(heap, world);
    }
}

static knurl_world *create(knurl_heap *heap, uint32_t capacity) {
    knurl_world *world = knurl_heap_alloc(heap, 1, sizeof *world);
    if (!world) {
        return NULL;
    }
    world->retired.release = release;
    world->capacity = capacity;
    world->items = knurl_heap_alloc(heap, capacity, sizeof *world->items);
    world->boxes = knurl_heap_alloc(heap, capacity, sizeof *world->boxes);
    world->loose = knurl_heap_alloc(heap, capacity, sizeof *world->loose);
    world->order = knurl_heap_alloc(heap, capacity, sizeof *world->order);
    world->is_loose = knurl_heap_alloc(heap, capacity, sizeof *world->is_loose);
    if (!world->items || !world->boxes || !world->loose || !world->order || !world->is_loose) {
        release(heap, &world->retired);
        return NULL;
    }
    return world;
}

/* Sorts what stands still into a hierarchy. `still`: places, count of them (> 0). */
static knurl_result build_hierarchy(knurl_heap *heap, knurl_world *world, uint32_t *still, uint32_t count) {
    knurl_box *boxes = knurl_heap_alloc(heap, count, sizeof *boxes);
    uint32_t *order = knurl_heap_alloc(heap, count, sizeof *order);
    knurl_result result = boxes && order ? KNURL_OK : KNURL_ERROR_MEMORY;
    for (uint32_t i = 0; !result && i < count; i++) {
        memcpy(boxes[i].min, world->boxes[still[i]], sizeof boxes[i].min);
        memcpy(boxes[i].max, world->boxes[still[i]] + 3, sizeof boxes[i].max);
    }
    result = result ? result : knurl_bvh_build(heap, boxes, count, LEAF_SIZE, order, &world->nodes, &world->node_count);
    for (uint32_t i = 0; !result && i < count; i++) {
        world->order[i] = still[order[i]];
    }
    knurl_heap_free(heap, boxes);
    knurl_heap_free(heap, order);
    return result;
}

static double room_of(const knurl_motion *motion) {
    const double way = motion->end_time > motion->start_time ? vec3_length(motion->velocity) * ROOM_SECONDS : 0.0;
    return fmin(ROOM + way, ROOM_MAX);
}

static void make_loose(knurl_world *world, uint32_t place) {
    if (!world->is_loose[place]) {
        knurl_store_relaxed(&world->is_loose[place], (uint8_t)1);
        world->loose[world->loose_count] = place;
        knurl_store_release(&world->loose_count, world->loose_count + 1);
    }
}

knurl_result knurl_world_rebuild(knurl_scene *scene, uint32_t capacity) {
    uint32_t *still = knurl_heap_alloc(&scene->heap, (uint64_t)scene->surface_count + 1, sizeof *still);
    knurl_world *world = still ? create(&scene->heap, capacity) : NULL;
    const double now = knurl_scene_time(scene);
    uint32_t still_count = 0;
    for (uint32_t i = 0; world && i < scene->surface_count; i++) {
        knurl_surface_data *surface = scene->surfaces[scene->order[i]];
        world->items[surface->place] = surface;
        make_box(surface, surface->record, now, 0.0, world->boxes[surface->place]);
        add_box(surface->record->arrived, world->boxes[surface->place]);
        if (surface->moved) {
            make_loose(world, surface->place);
        } else {
            still[still_count++] = surface->place;
        }
    }
    if (!world || (still_count > 0 && build_hierarchy(&scene->heap, world, still, still_count) != KNURL_OK)) {
        release(&scene->heap, world ? &world->retired : NULL);
        knurl_heap_free(&scene->heap, still);
        return KNURL_ERROR_MEMORY;
    }
    knurl_heap_free(&scene->heap, still);
    for (uint32_t i = 0; i < scene->surface_count; i++) {
        scene->surfaces[scene->order[i]]->moved = 0;
    }
    scene->moves = 0;
    knurl_world *old = __atomic_exchange_n(&scene->world, world, __ATOMIC_SEQ_CST);
    knurl_store_release(&scene->version, scene->version + 1);
    if (old) {
        knurl_scene_retire(scene, &old->retired);
    }
    return KNURL_OK;
}

/* Whether building anew would make lists quicker to find: it costs about as much as the moves since the last time. */
static int is_worth_it(const knurl_scene *scene) {
    const uint32_t loose = scene->world->loose_count;
    return loose > LOOSE_MIN + scene->surface_count / 4 && scene->moves > 8 * (uint64_t)loose;
}

knurl_result knurl_world_add(knurl_scene *scene, knurl_surface_data *surface) {
    knurl_world *world = scene->world;
    const uint32_t capacity = world ? world->capacity : 0;
    if (surface->place >= capacity || world->loose_count > LOOSE_MIN + scene->surface_count / 4) {
        const uint32_t larger = scene->surface_count + scene->surface_count / 2 + LOOSE_MIN;
        return knurl_world_rebuild(scene, larger > scene->capacity ? larger : scene->capacity);
    }
    store_box(world->boxes[surface->place], surface->record->arrived);
    make_loose(world, surface->place);
    __atomic_store_n(&world->items[surface->place], surface, __ATOMIC_SEQ_CST);
    knurl_store_release(&scene->version, scene->version + 1);
    return KNURL_OK;
}

static int holds(const float outer[6], const float inner[6]) {
    return outer[0] <= inner[0] && outer[1] <= inner[1] && outer[2] <= inner[2] && outer[3] >= inner[3] &&
           outer[4] >= inner[4] && outer[5] >= inner[5];
}

/* Lists were made from the stored box and, once a motion was over, from the box of where it had arrived. While the new
 * motion stays within the latter, they hold. */
void knurl_world_publish(knurl_scene *scene, knurl_surface_data *surface, knurl_record *record) {
    knurl_world *world = scene->world;
    float swept[6];
    make_box(surface, record, knurl_scene_time(scene), 0.0, swept);
    const int stays = world && holds(record->arrived, swept); /* still the old record's */
    if (!stays) {
        knurl_record_set_box(surface, record, world ? room_of(&record->motion) : 0.0);
        add_box(record->arrived, swept);
    }
    if (!stays && world) {
        float both[6];
        memcpy(both, swept, sizeof both);
        add_box(world->boxes[surface->place], both);
        store_box(world->boxes[surface->place], both);
        make_loose(world, surface->place);
        knurl_store_release(&scene->version, scene->version + 1);
    }
    knurl_record *old = __atomic_exchange_n(&surface->record, record, __ATOMIC_SEQ_CST);
    if (!stays && world) { /* lists that were made meanwhile hold more than they need */
        store_box(world->boxes[surface->place], swept);
        knurl_store_release(&scene->version, scene->version + 1);
    }
    knurl_scene_retire(scene, &old->retired);
    if (world && is_worth_it(scene)) {
        (void)knurl_world_rebuild(scene, world->capacity); /* without memory for it, the old one serves */
    }
}

void knurl_world_remove(knurl_scene *scene, knurl_surface_data *surface) {
    if (scene->world) {
        __atomic_store_n(&scene->world->items[surface->place], NULL, __ATOMIC_SEQ_CST);
        knurl_store_release(&scene->version, scene->version + 1);
    }
    knurl_scene_retire(scene, &surface->retired);
}

static int meets(const float *box, const knurl_view *view) {
    for (int i = 0; i < 3; i++) {
        float least;
        float greatest;
        __atomic_load(&box[i], &least, __ATOMIC_RELAXED);
        __atomic_load(&box[3 + i], &greatest, __ATOMIC_RELAXED);
        if (view->high[i] < (double)least || view->low[i] > (double)greatest) {
            return 0;
        }
    }
    return 1;
}

/* A stored box holds all of a way; what has arrived, or is asked for exactly, is in less of it. */
static int is_there(const knurl_world *world, uint32_t place, const knurl_view *view) {
    if (!meets(world->boxes[place], view)) {
        return 0;
    }
    const knurl_surface_data *surface = __atomic_load_n(&world->items[place], __ATOMIC_SEQ_CST);
    if (!surface || !knurl_load_relaxed(&world->is_loose[place])) {
        return surface != NULL; /* what stands still fills its box */
    }
    const knurl_record *record = __atomic_load_n(&surface->record, __ATOMIC_SEQ_CST);
    if (view->exact) {
        float box[6];
        make_box(surface, record, view->time, 0.0, box);
        return meets(box, view);
    }
    return !knurl_motion_is_over(&record->motion, view->time) || meets(record->arrived, view);
}

/* A place may be found twice, loose and in the hierarchy. */
static uint32_t note(uint32_t place, uint32_t room, uint32_t count, uint32_t *places) {
    for (uint32_t i = 0; i < count && i < room; i++) {
        if (places[i] == place) {
            return count;
        }
    }
    if (count < room) {
        places[count] = place;
    }
    return count + 1;
}

static int node_meets(const knurl_bvh_node *node, const knurl_view *view) {
    for (int i = 0; i < 3; i++) {
        if (view->high[i] < (double)node->min[i] || view->low[i] > (double)node->max[i]) {
            return 0;
        }
    }
    return 1;
}

static uint32_t find_still(const knurl_world *world, const knurl_view *view, uint32_t room, uint32_t count,
                           uint32_t *places) {
    uint32_t stack[KNURL_BVH_MAX_DEPTH];
    uint32_t top = 0;
    if (world->node_count > 0) {
        stack[top++] = 0;
    }
    while (top > 0 && count <= room) {
        const uint32_t index = stack[--top];
        const knurl_bvh_node *node = &world->nodes[index];
        if (!node_meets(node, view)) {
            continue;
        }
        for (uint32_t i = 0; i < node->count && count <= room; i++) {
            const uint32_t place = world->order[node->first + i];
            if (is_there(world, place, view)) { /* it may have gone from here since */
                count = note(place, room, count, places);
            }
        }
        if (node->count == 0) {
            stack[top++] = node->first;
            stack[top++] = index + 1;
        }
    }
    return count;
}

uint32_t knurl_world_find(const knurl_world *world, const knurl_view *view, uint32_t room, uint32_t *places) {
    uint32_t count = 0;
    if (view->everything) {
        for (uint32_t place = 0; place < world->capacity && count <= room; place++) {
            if (is_there(world, place, view)) {
                count = note(place, room, count, places);
            }
        }
        return count;
    }
    const uint32_t loose = knurl_load_acquire(&world->loose_count);
    for (uint32_t i = 0; i < loose && count <= room; i++) {
        if (is_there(world, world->loose[i], view)) {
            count = note(world->loose[i], room, count, places);
        }
    }
    return find_still(world, view, room, count, places);
}

/* Which surfaces are near a HIP: looked up when the HIP has moved some millimetres or an edit says so, not in every
 * tick. However many surfaces there are, most ticks look at the few in this list. SPDX-License-Identifier: MIT */
#include "scene/scene_internal.h"

#include "base/atomic.h"

#include <string.h>

/* How far round its path a HIP looks, m: at 250 mm/s a list serves for 40 ticks. Where more surfaces are in there than
 * a list holds, it looks less far, down to what the tick itself needs. */
static const double margins[] = {0.01, 0.001, 0.0};

/* What remains near keeps its state; what is in contact stays whether its box is near or not. */
static uint32_t keep(knurl_near *list, uint32_t count, const uint32_t *places, uint32_t found) {
    uint32_t kept = 0;
    for (uint32_t i = 0; i < count; i++) {
        int stays = list[i].in_contact != 0;
        for (uint32_t k = 0; k < found && !stays; k++) {
            stays = places[k] == list[i].place;
        }
        if (stays && kept++ != i) {
            list[kept - 1] = list[i];
        }
    }
    return kept;
}

/* In the order of places, so that sums of forces do not depend on how the list came to be. */
static void insert(knurl_hip *hip, uint32_t place) {
    uint32_t at = 0;
    while (at < hip->near_count && hip->near[at].place < place) {
        at++;
    }
    if (at < hip->near_count && hip->near[at].place == place) {
        return;
    }
    if (hip->near_count == KNURL_MAX_NEAR) {
        hip->near_overflow = 1;
        return;
    }
    memmove(&hip->near[at + 1], &hip->near[at], (hip->near_count - at) * sizeof hip->near[0]);
    memset(&hip->near[at], 0, sizeof hip->near[0]);
    hip->near[at].place = place;
    hip->near_count++;
}

static void load_box(const knurl_world *world, knurl_near *near) {
    for (int i = 0; i < 6; i++) {
        __atomic_load(&world->boxes[near->place][i], &near->box[i], __ATOMIC_RELAXED);
    }
}

void knurl_hip_look_around(const knurl_scene *scene, const knurl_world *world, knurl_hip *hip,
                           const double position[3]) {
    const int everything = (scene->full_model & KNURL_FULL_SEARCH) != 0;
    const uint64_t version = knurl_load_acquire(&scene->version); /* before the boxes are read */
    const double *from = hip->has_previous ? hip->previous : position;
    uint32_t places[KNURL_MAX_NEAR];
    uint32_t found = KNURL_MAX_NEAR + 1;
    for (size_t m = everything ? 2 : 0; m < 3 && found > KNURL_MAX_NEAR; m++) {
        /* a surface that has just jumped here, and a first tick, may be felt this far */
        const double margin = margins[m] + 1e-9 + (m < 2 || !hip->has_previous ? KNURL_CAPTURE_DEPTH : 0.0);
        for (int i = 0; i < 3; i++) {
            hip->near_low[i] = fmin(from[i], position[i]) - margin;
            hip->near_high[i] = fmax(from[i], position[i]) + margin;
        }
        found = knurl_world_find(world, hip->near_low, hip->near_high, everything, KNURL_MAX_NEAR, places);
    }
    hip->version = version;
    hip->near_overflow = found > KNURL_MAX_NEAR;
    found = hip->near_overflow ? KNURL_MAX_NEAR : found;
    hip->near_count = keep(hip->near, hip->near_count, places, found);
    for (uint32_t i = 0; i < found; i++) {
        insert(hip, places[i]);
    }
    for (uint32_t i = 0; i < hip->near_count; i++) {
        if (hip->near[i].place < world->capacity) {
            load_box(world, &hip->near[i]);
        }
    }
}

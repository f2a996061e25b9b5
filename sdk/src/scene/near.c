/* Which surfaces are near a HIP: looked up when the HIP has moved some millimetres or an edit says so, not in every
 * tick. However many surfaces there are, most ticks look at the few in this list. SPDX-License-Identifier: MIT */
#include "scene/scene_internal.h"

#include "base/atomic.h"

#include <string.h>

/* How far a HIP looks, m. margin: how far it may go before it looks again; at 250 mm/s the first serves for 40 ticks.
 * capture: how deep it may find itself in a surface at a first tick. Where more surfaces are in there than a list
 * holds, the next is tried, down to what the tick itself needs. */
static const struct {
    double margin;
    double capture;
} views[] = {{0.01, KNURL_CAPTURE_DEPTH},
             {0.003, KNURL_CAPTURE_DEPTH},
             {0.001, KNURL_CAPTURE_DEPTH},
             {0.0, KNURL_CAPTURE_DEPTH},
             {0.0, 0.003},
             {0.0, 0.001}};
#define VIEWS   (sizeof views / sizeof *views)
#define NARROWS 3 /* the first without a margin */

/* A HIP pressed deeper than at the latest look, by more than this (m), looks again: what it may slide onto is that far
 * above it. */
#define DEEPER 0.002

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
    size_t v = 0;
    for (; v < VIEWS && found > KNURL_MAX_NEAR; v++) {
        hip->near_depth = hip->depth + (v < NARROWS ? DEEPER : 1e-4);
        const double reach = 1e-9 + fmax(hip->near_depth, hip->has_previous ? 0.0 : views[v].capture);
        double low[3];
        double high[3];
        for (int i = 0; i < 3; i++) {
            hip->near_low[i] = fmin(from[i], position[i]) - views[v].margin;
            hip->near_high[i] = fmax(from[i], position[i]) + views[v].margin;
            low[i] = hip->near_low[i] - reach;
            high[i] = hip->near_high[i] + reach;
        }
        const knurl_view view = {low, high, hip->time, everything, v >= NARROWS};
        found = knurl_world_find(world, &view, KNURL_MAX_NEAR, places);
    }
    hip->version = v > NARROWS ? 0 : version; /* a look without margin serves for this tick */
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

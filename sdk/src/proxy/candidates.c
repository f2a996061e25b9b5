/* The surfaces near a HIP. A query of the broad phase runs only after the HIP has moved some millimetres or after an
 * edit; most ticks test only this list, however many surfaces the scene has. SPDX-License-Identifier: MIT */
#include "proxy/candidates.h"

#include <stddef.h>
#include <string.h>

/* The sizes of a query, m, widest first. margin: distance that the HIP may move before the next query; at 250 mm/s the
 * first lasts for 120 ticks, so fewer than one tick in a hundred makes a query. deeper: how much deeper the HIP may be
 * pressed until then, because surfaces that it may slide onto are that far above it. capture: depth at which a first
 * tick still finds the HIP inside a surface. If a query finds more surfaces than a list holds, the next size is tried,
 * down to the one that the tick itself needs. */
static const struct {
    double margin;
    double deeper;
    double capture;
} views[] = {{0.03, 0.002, KNURL_CAPTURE_DEPTH},
             {0.01, 0.002, KNURL_CAPTURE_DEPTH},
             {0.003, 0.001, KNURL_CAPTURE_DEPTH},
             {0.001, 0.0005, KNURL_CAPTURE_DEPTH},
             {0.0005, 0.0002, KNURL_CAPTURE_DEPTH},
             {0.0, 0.0001, KNURL_CAPTURE_DEPTH},
             {0.0, 0.0001, 0.003},
             {0.0, 0.0001, 0.001}};
#define VIEWS   (sizeof views / sizeof *views)
#define NARROWS 5 /* index of the first size without a margin */

/* Above this number of surfaces the next size is tried, as long as it has a margin: ticks near a seam test the whole
 * list, and a long list takes longer to build. A query also tests all dynamic surfaces, so with many of those a longer
 * list and fewer queries are faster. */
#define ENOUGH            12
#define DYNAMIC_A_SURFACE 16 /* so many dynamic surfaces lengthen the list by one */

/* m: subtracted from a clearance: the margin passed to knurl_candidate_is_near(), 1e-9, and rounding. */
#define ROUNDING 2e-9

static void sort_places(uint32_t *places, uint32_t count) {
    for (uint32_t i = 1; i < count; i++) {
        const uint32_t place = places[i];
        uint32_t at = i;
        for (; at > 0 && places[at - 1] > place; at--) {
            places[at] = places[at - 1];
        }
        places[at] = place;
    }
}

/* Removes surfaces that are no longer near, except those in contact. The others keep their state. */
static void remove_others(knurl_candidates *c, const uint32_t *places, uint32_t found) {
    uint32_t kept = 0, k = 0;
    for (uint32_t i = 0; i < c->count; i++) {
        const knurl_candidate *candidate = knurl_candidates_at(c, i);
        while (k < found && places[k] < candidate->place) {
            k++;
        }
        if (candidate->in_contact || (k < found && places[k] == candidate->place)) {
            c->order[kept++] = c->order[i];
        } else {
            c->used &= ~(1u << c->order[i]);
        }
    }
    c->count = kept;
}

/* Takes a free slot. Its poses and facet are not cleared: they are read only while `placed` and `facet.side` are not 0.
 */
static uint8_t take_slot(knurl_candidates *c, uint32_t place) {
    const uint8_t slot = (uint8_t)__builtin_ctz(~c->used);
    knurl_candidate *candidate = &c->slots[slot];
    c->used |= 1u << slot;
    memset(candidate, 0, offsetof(knurl_candidate, poses));
    knurl_part_clear(&candidate->part);
    candidate->facet.side = 0;
    candidate->place = place;
    return slot;
}

/* Inserts in order of places, so that sums of forces do not depend on the list's history. */
static void insert_new(knurl_candidates *c, const uint32_t *places, uint32_t found) {
    uint8_t order[KNURL_CANDIDATES_MAX];
    uint32_t count = 0, i = 0;
    for (uint32_t k = 0; k < found; k++) {
        while (i < c->count && knurl_candidates_at(c, i)->place < places[k]) {
            order[count++] = c->order[i++];
        }
        if (i < c->count && knurl_candidates_at(c, i)->place == places[k]) {
            order[count++] = c->order[i++];
        } else if (count + (c->count - i) < KNURL_CANDIDATES_MAX) {
            order[count++] = take_slot(c, places[k]);
        } else {
            c->overflow = 1;
        }
    }
    while (i < c->count) {
        order[count++] = c->order[i++];
    }
    memcpy(c->order, order, count);
    c->count = count;
}

static void load_box(const knurl_broad_index *index, knurl_candidate *candidate) {
    const float *from = index->boxes[candidate->place];
    for (int i = 0; i < 6; i++) {
        __atomic_load(&from[i], &candidate->box[i], __ATOMIC_RELAXED);
    }
}

/* Queries at one size before a wider one is tried. */
#define WIDER_AFTER 256

static uint32_t first_view(const knurl_candidates *c, const knurl_hip_path *path) {
    return path->is_first ? 0 : c->view > 0 && c->queries >= WIDER_AFTER ? c->view - 1 : c->view;
}

/* After a query of a wider size has fitted, the next one tries a still wider size. A first tick's query is larger than
 * later ones, so its size is not kept. */
static void keep_view(knurl_candidates *c, const knurl_hip_path *path, uint32_t first, uint32_t served) {
    if (!path->is_first) {
        c->queries = served < c->view ? WIDER_AFTER : first < c->view ? 0 : c->queries + 1;
        c->view = served;
    }
}

/* Number of surfaces above which a query tries the next size. */
static uint32_t find_limit(const knurl_broad_index *index, uint32_t view) {
    const uint32_t enough = ENOUGH + knurl_load_relaxed(&index->dynamic_count) / DYNAMIC_A_SURFACE;
    return view + 1 < NARROWS && enough < KNURL_CANDIDATES_MAX ? enough : KNURL_CANDIDATES_MAX;
}

/* Fills the list from the broad phase. */
static void query_broad_phase(knurl_candidates *c, const knurl_broad_phase *phase, const knurl_broad_index *index,
                              const knurl_hip_path *path) {
    const uint64_t version = knurl_load_acquire(&phase->version); /* before the boxes are read */
    uint32_t places[KNURL_CANDIDATES_MAX];
    uint32_t found;
    const uint32_t first = first_view(c, path);
    uint32_t v = first;
    for (;; v++) {
        c->depth = path->depth + views[v].deeper;
        const double reach = 1e-9 + knurl_max(c->depth, path->is_first ? views[v].capture : 0.0);
        double low[3];
        double high[3];
        for (int i = 0; i < 3; i++) {
            c->low[i] = knurl_min(path->from[i], path->to[i]) - views[v].margin;
            c->high[i] = knurl_max(path->from[i], path->to[i]) + views[v].margin;
            low[i] = c->low[i] - reach;
            high[i] = c->high[i] + reach;
        }
        const knurl_broad_query query = {low, high, path->time, path->test_all, v >= NARROWS};
        const uint32_t limit = find_limit(index, v);
        found = knurl_broad_phase_find(index, &query, limit, places);
        if (found <= limit || v + 1 == VIEWS) {
            break;
        }
    }
    keep_view(c, path, first, v);
    c->version = v >= NARROWS ? 0 : version; /* without a margin the list is valid in this tick only */
    c->overflow = found > KNURL_CANDIDATES_MAX;
    found = c->overflow ? KNURL_CANDIDATES_MAX : found;
    sort_places(places, found);
    remove_others(c, places, found);
    insert_new(c, places, found);
    for (uint32_t i = 0; i < c->count; i++) {
        knurl_candidate *candidate = knurl_candidates_at(c, i);
        if (candidate->place < index->capacity) {
            load_box(index, candidate);
        }
        candidate->swept_tick = 0; /* the place may hold another surface now */
    }
}

void knurl_candidates_reset(knurl_candidates *c) {
    c->count = c->view = c->queries = c->used = 0;
    c->clearance.distance = -1.0;
}

void knurl_candidates_update(knurl_candidates *c, const knurl_broad_phase *phase, const knurl_broad_index *index,
                             const knurl_hip_path *path) {
    int inside = 1;
    for (int i = 0; i < 3; i++) {
        inside &= path->to[i] >= c->low[i] && path->to[i] <= c->high[i];
    }
    if (c->version != knurl_load_acquire(&phase->version) || path->is_first || !inside || path->depth > c->depth ||
        c->overflow || path->test_all) {
        query_broad_phase(c, phase, index, path);
    }
}

void knurl_candidates_look_ahead(knurl_candidates *c, const knurl_broad_phase *phase, const knurl_broad_index *index,
                                 const knurl_hip_path *path) {
    knurl_hip_path next = *path;
    double to[3];
    int leaves = 0;
    for (int i = 0; i < 3; i++) {
        to[i] = 2.0 * path->to[i] - path->from[i];
        leaves |= to[i] < c->low[i] || to[i] > c->high[i];
    }
    if (leaves && c->version != 0) {
        next.from = path->to;
        next.to = to;
        query_broad_phase(c, phase, index, &next);
    }
}

/* m: from a point to a candidate's box, along the axis of the largest distance; negative inside. */
static double gap(const knurl_candidate *candidate, const double p[3]) {
    double widest = -HUGE_VAL;
    for (int i = 0; i < 3; i++) {
        const double below = (double)candidate->box[i] - p[i];
        const double above = p[i] - (double)candidate->box[3 + i];
        widest = below > widest ? below : widest;
        widest = above > widest ? above : widest;
    }
    return widest;
}

void knurl_candidates_measure(knurl_candidates *c, const double position[3], const double proxy[3], int again) {
    double distance = again || c->overflow ? -1.0 : HUGE_VAL;
    for (int i = 0; i < 3; i++) {
        distance = knurl_min(distance, knurl_min(position[i] - c->low[i], c->high[i] - position[i]));
    }
    for (uint32_t i = 0; i < c->count && distance > 0.0; i++) { /* a negative distance means no clearance */
        const knurl_candidate *candidate = knurl_candidates_at(c, i);
        if (!candidate->in_contact) {
            distance = knurl_min(distance, knurl_min(gap(candidate, position), gap(candidate, proxy)));
        }
    }
    c->clearance.distance = distance - ROUNDING;
    vec3_copy(position, c->clearance.at);
    vec3_copy(proxy, c->clearance.proxy);
}

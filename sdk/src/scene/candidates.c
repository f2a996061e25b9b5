/* The surfaces near a HIP. They are looked up when the HIP has moved some millimetres or after an edit, not in every
 * tick; so most ticks test only this list, however many surfaces the scene has.
 * SPDX-License-Identifier: MIT */
#include "scene/candidates.h"

#include <string.h>

/* The sizes of a query, m, widest first. margin: how far the HIP may move before the next query; at 250 mm/s the first
 * lasts for 120 ticks, so that fewer than one tick in a hundred makes one. deeper: how much deeper the HIP may be
 * pressed until then, because surfaces that it may slide onto are that far above it. capture: how deep the HIP may be
 * in a surface on a first tick. Where a query finds more surfaces than a list holds, the next size is tried, down to
 * what the tick itself needs. */
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
#define NARROWS 5 /* the first without a margin */

/* With more surfaces in a list the next size is tried, as long as it has a margin: ticks near a seam test all of them,
 * and a long list takes longer to make. But a query also tests all dynamic surfaces, so many of them are best looked at
 * rarely. */
#define ENOUGH            12
#define DYNAMIC_A_SURFACE 16 /* so many dynamic surfaces are worth one more in the list */

/* m: subtracted from a clearance: the margin passed to knurl_candidate_is_near(), 1e-9, and rounding. */
#define ROUNDING 2e-9

/* Removes the surfaces that are no longer near, except those in contact. The others keep their state. */
static uint32_t keep(knurl_candidate *list, uint32_t count, const uint32_t *places, uint32_t found) {
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

/* Inserts in order of places, so that sums of forces do not depend on the list's history. */
static void insert(knurl_candidates *c, uint32_t place) {
    uint32_t at = 0;
    while (at < c->count && c->list[at].place < place) {
        at++;
    }
    if (at < c->count && c->list[at].place == place) {
        return;
    }
    if (c->count == KNURL_CANDIDATES_MAX) {
        c->overflow = 1;
        return;
    }
    memmove(&c->list[at + 1], &c->list[at], (c->count - at) * sizeof c->list[0]);
    memset(&c->list[at], 0, sizeof c->list[0]);
    c->list[at].place = place;
    c->count++;
}

static void load_box(const knurl_broad_index *index, knurl_candidate *candidate) {
    for (int i = 0; i < 6; i++) {
        __atomic_load(&index->boxes[candidate->place][i], &candidate->box[i], __ATOMIC_RELAXED);
    }
}

/* So many queries at one size until a wider one is tried again. */
#define WIDER_AFTER 256

static uint32_t first_view(const knurl_candidates *c, const knurl_hip_path *path) {
    return path->is_first ? 0 : c->view > 0 && c->queries >= WIDER_AFTER ? c->view - 1 : c->view;
}

/* Where a wider size fits the list, the next query tries a still wider one. A first tick's query looks farther than
 * later ones: its size says nothing about theirs. */
static void keep_view(knurl_candidates *c, const knurl_hip_path *path, uint32_t first, uint32_t served) {
    if (!path->is_first) {
        c->queries = served < c->view ? WIDER_AFTER : first < c->view ? 0 : c->queries + 1;
        c->view = served;
    }
}

static int is_too_much(const knurl_broad_index *index, uint32_t view, uint32_t found) {
    const uint32_t enough = ENOUGH + knurl_load_relaxed(&index->dynamic_count) / DYNAMIC_A_SURFACE;
    return view + 1 < VIEWS && (found > KNURL_CANDIDATES_MAX || (view + 1 < NARROWS && found > enough));
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
        const knurl_view view = {low, high, path->time, path->everything, v >= NARROWS};
        found = knurl_broad_phase_find(index, &view, KNURL_CANDIDATES_MAX, places);
        if (!is_too_much(index, v, found)) {
            break;
        }
    }
    keep_view(c, path, first, v);
    c->version = v >= NARROWS ? 0 : version; /* without a margin it is valid in this tick only */
    c->overflow = found > KNURL_CANDIDATES_MAX;
    found = c->overflow ? KNURL_CANDIDATES_MAX : found;
    c->count = keep(c->list, c->count, places, found);
    for (uint32_t i = 0; i < found; i++) {
        insert(c, places[i]);
    }
    for (uint32_t i = 0; i < c->count; i++) {
        if (c->list[i].place < index->capacity) {
            load_box(index, &c->list[i]);
        }
        c->list[i].swept_tick = 0; /* another surface may be in its place */
    }
}

void knurl_candidates_reset(knurl_candidates *c) {
    c->count = c->view = c->queries = 0;
    c->clearance.distance = -1.0;
}

void knurl_candidates_update(knurl_candidates *c, const knurl_broad_phase *phase, const knurl_broad_index *index,
                             const knurl_hip_path *path) {
    int inside = 1;
    for (int i = 0; i < 3; i++) {
        inside &= path->to[i] >= c->low[i] && path->to[i] <= c->high[i];
    }
    if (c->version != knurl_load_acquire(&phase->version) || path->is_first || !inside || path->depth > c->depth ||
        c->overflow || path->everything) {
        query_broad_phase(c, phase, index, path);
    }
}

/* m: from a point to a candidate's box, along the axis where they are farthest apart; negative inside. */
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
    for (uint32_t i = 0; i < c->count && distance > 0.0; i++) { /* below 0 it makes no difference how far */
        if (!c->list[i].in_contact) {
            distance = knurl_min(distance, knurl_min(gap(&c->list[i], position), gap(&c->list[i], proxy)));
        }
    }
    c->clearance.distance = distance - ROUNDING;
    vec3_copy(position, c->clearance.at);
    vec3_copy(proxy, c->clearance.proxy);
}

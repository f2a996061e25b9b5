/* The surfaces that one HIP may touch: a short list, and the distance that the HIP can move before it must be tested
 * against them. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_CANDIDATES_H
#define KNURL_SRC_CANDIDATES_H

#include "base/atomic.h"
#include "base/base.h"
#include "proxy/candidate.h"
#include "surface/broad_phase.h"

/* Most surfaces that a tick tests against a HIP. */
#define KNURL_CANDIDATES_MAX 32

/* While the HIP is within `distance` (m, each axis) of `at`, the list is complete and the HIP enters only boxes of
 * surfaces in contact. The same holds for its proxy within `distance` of `proxy`. */
typedef struct knurl_clearance {
    double at[3];
    double proxy[3];
    double distance; /* below 0: unknown */
} knurl_clearance;

typedef struct knurl_candidates {
    double low[3]; /* box, scene axes: the list is complete while the HIP stays in it, */
    double high[3];
    double depth;     /* m: is pressed no deeper than this, */
    uint64_t version; /* and the broad phase's version is this; 0: query again */
    uint32_t count;
    uint32_t overflow; /* 1: more surfaces were found than fit */
    uint32_t view;     /* index of the last query's size; 0: widest */
    uint32_t queries;  /* since a wider size was tried */
    knurl_clearance clearance;
    uint32_t used;                               /* bit i: slot i holds a surface */
    uint8_t order[KNURL_CANDIDATES_MAX];         /* the list: `count` slots, in order of their surfaces' places */
    knurl_candidate slots[KNURL_CANDIDATES_MAX]; /* a surface stays in its slot while it is in the list */
} knurl_candidates;

/* The list's candidate number i. */
static inline knurl_candidate *knurl_candidates_at(knurl_candidates *c, uint32_t i) {
    return &c->slots[c->order[i]];
}

/* The candidate's surface, or null if it was removed. If another surface has taken its place, the contact ends. */
static inline const knurl_surface_data *knurl_candidate_surface(const knurl_broad_index *index,
                                                                knurl_candidate *candidate) {
    const knurl_surface_data *surface =
        candidate->place < index->capacity ? __atomic_load_n(&index->items[candidate->place], __ATOMIC_SEQ_CST) : NULL;
    if (KNURL_UNLIKELY(!surface || candidate->generation != surface->generation)) {
        knurl_candidate_note_change(candidate, surface);
    }
    return surface;
}

/* Empties the list. */
void knurl_candidates_reset(knurl_candidates *candidates) KNURL_NONBLOCKING;

/* Makes the list complete for a path, if it is not yet. */
void knurl_candidates_update(knurl_candidates *candidates, const knurl_broad_phase *phase,
                             const knurl_broad_index *index, const knurl_hip_path *path) KNURL_NONBLOCKING;

/* For a tick with little other work: if the HIP, at its present velocity, would leave the list's box in the next tick,
 * makes the list anew now. Few ticks then have to do that and find joint contact. */
void knurl_candidates_look_ahead(knurl_candidates *candidates, const knurl_broad_phase *phase,
                                 const knurl_broad_index *index, const knurl_hip_path *path) KNURL_NONBLOCKING;

/* 1 if the list is complete and only surfaces in contact need to be tested, as in most ticks. depth: m, of the deepest
 * contact. */
static inline int knurl_candidates_are_clear(const knurl_candidates *c, const knurl_broad_phase *phase,
                                             const double p[3], double depth) {
    const knurl_clearance *clear = &c->clearance;
    return KNURL_LIKELY(fabs(p[0] - clear->at[0]) < clear->distance && fabs(p[1] - clear->at[1]) < clear->distance &&
                        fabs(p[2] - clear->at[2]) < clear->distance && depth <= c->depth &&
                        c->version == knurl_load_acquire(&phase->version));
}

/* The same for a proxy at p. */
static inline int knurl_candidates_are_clear_of(const knurl_candidates *c, const double p[3]) {
    const knurl_clearance *clear = &c->clearance;
    return KNURL_LIKELY(fabs(p[0] - clear->proxy[0]) < clear->distance &&
                        fabs(p[1] - clear->proxy[1]) < clear->distance &&
                        fabs(p[2] - clear->proxy[2]) < clear->distance);
}

/* Measures the clearance at a position and a proxy from the candidates that are not in contact. again: 1: leave no
 * clearance, so that the next tick tests all of them. */
void knurl_candidates_measure(knurl_candidates *candidates, const double position[3], const double proxy[3],
                              int again) KNURL_NONBLOCKING;

#endif

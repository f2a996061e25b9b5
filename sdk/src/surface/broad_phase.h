/* The broad phase: finds the surfaces near a HIP. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_BROAD_PHASE_H
#define KNURL_SRC_BROAD_PHASE_H

#include "contact/bvh.h"
#include "surface/surfaces.h"

/* Dynamic surfaces are searched in groups of this size: a group whose box is far away is skipped. */
#define KNURL_DYNAMIC_GROUP 16

/* What ticks look into: a hierarchy over the surfaces that stood still when it was built, and a list of the dynamic
 * ones: those that were moved, or added, since. */
typedef struct knurl_broad_index {
    knurl_retired retired;
    knurl_surface_data **items; /* by place; atomic; null: nothing there */
    float (*boxes)[6];          /* by place: min and max in scene axes, reach included; atomic, may be seen half new */
    uint32_t *dynamic;          /* places; may name one that is empty by now */
    uint32_t *order;            /* places in the hierarchy's leaf order */
    knurl_bvh_node *nodes;
    uint32_t node_count;    /* 0: nothing stands still */
    uint32_t capacity;      /* places */
    uint32_t dynamic_count; /* atomic */
    float (*groups)[6];     /* of every KNURL_DYNAMIC_GROUP of `dynamic`: a box around their boxes; atomics */
    uint32_t *rank;         /* by place; atomic: where it is in `dynamic`, from 1; 0: still since the index was built */
} knurl_broad_index;

typedef struct knurl_broad_phase {
    knurl_broad_index *index; /* atomic; null before the commit */
    uint64_t version;         /* atomic; from 1: what lists of candidates were made of has changed */
    /* for edits, under their lock */
    knurl_epoch *epoch;
    const knurl_surfaces *surfaces;
    uint64_t moves; /* since the index was built */
} knurl_broad_phase;

/* epoch, surfaces: the scene's; they outlive it. */
void knurl_broad_phase_init(knurl_broad_phase *phase, knurl_epoch *epoch, const knurl_surfaces *surfaces);

/* No tick runs any more. */
void knurl_broad_phase_release(knurl_broad_phase *phase);

/* Edits. time: s, of the HIP that is ahead.
 *
 * A new index with room for `capacity` places. Errors: KNURL_ERROR_MEMORY. */
knurl_result knurl_broad_phase_rebuild(knurl_broad_phase *phase, uint32_t capacity, double time);

/* A surface has come to its place. Errors: KNURL_ERROR_MEMORY. */
knurl_result knurl_broad_phase_add(knurl_broad_phase *phase, knurl_surface_data *surface, double time);

/* Swaps a surface's record for a new one, and keeps its box right meanwhile. Also before the commit. */
void knurl_broad_phase_publish(knurl_broad_phase *phase, knurl_surface_data *surface, knurl_record *record,
                               double time);

/* A surface has taken another's place; that one is released once no tick can see it. Also before the commit. */
void knurl_broad_phase_replace(knurl_broad_phase *phase, knurl_surface_data *old, knurl_surface_data *made);

/* A surface goes, and is released once no tick can see it. Also before the commit. */
void knurl_broad_phase_remove(knurl_broad_phase *phase, knurl_surface_data *surface);

/* What to look for. */
typedef struct knurl_view {
    const double *low; /* a box, scene axes, m */
    const double *high;
    double time;    /* s: what has arrived by then is where it is */
    int everything; /* 1: without the hierarchy */
    int exact;      /* 1: without the margin around what moves */
} knurl_view;

/* Places of the surfaces that a view meets. At most `limit` of them are written; returns how many there are, at most
 * limit + 1. In a tick. */
uint32_t knurl_broad_phase_find(const knurl_broad_index *index, const knurl_view *view, uint32_t limit,
                                uint32_t *places) KNURL_NONBLOCKING;

#endif

/* The broad phase: finds the surfaces near a HIP. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_BROAD_PHASE_H
#define KNURL_SRC_BROAD_PHASE_H

#include "contact/bvh.h"
#include "surface/surfaces.h"

/* Dynamic surfaces are searched in groups of this size: a group whose box is far away is skipped. */
#define KNURL_DYNAMIC_GROUP 16

/* The data that ticks search: a hierarchy over the surfaces that were at rest when it was built, and a list of the
 * dynamic ones: those that were moved, or added, since. */
typedef struct knurl_broad_index {
    knurl_retired retired;
    knurl_surface_data **items; /* by place; atomic; null: empty */
    float (*boxes)[6]; /* by place: min and max, scene axes, reach included; atomic floats, may be half updated */
    uint32_t *dynamic; /* places; may include some that are empty by now */
    uint32_t *order;   /* places in the hierarchy's leaf order */
    knurl_bvh_node *nodes;
    uint32_t node_count;    /* 0: no surface is at rest */
    uint32_t capacity;      /* places */
    uint32_t dynamic_count; /* atomic */
    float (*groups)[6];     /* by group of KNURL_DYNAMIC_GROUP in `dynamic`: a box around their boxes; atomic floats */
    uint32_t *rank;         /* by place; atomic: 1 + index in `dynamic`; 0: at rest since the index was built */
} knurl_broad_index;

typedef struct knurl_broad_phase {
    knurl_broad_index *index; /* atomic; null before the commit */
    uint64_t version;         /* atomic; from 1: incremented when lists of candidates become invalid */
    /* for edits, under the scene's lock */
    knurl_epoch *epoch;
    const knurl_surfaces *surfaces;
    uint64_t moves; /* since the index was built */
} knurl_broad_phase;

/* epoch, surfaces: the scene's; they outlive it. */
void knurl_broad_phase_init(knurl_broad_phase *phase, knurl_epoch *epoch, const knurl_surfaces *surfaces);

/* No tick may run any more. */
void knurl_broad_phase_release(knurl_broad_phase *phase);

/* Edits. time: s, of the HIP that is ahead.
 *
 * Builds a new index with room for `capacity` places. Errors: KNURL_ERROR_MEMORY. */
knurl_result knurl_broad_phase_rebuild(knurl_broad_phase *phase, uint32_t capacity, double time);

/* Adds a surface, which has its place. Errors: KNURL_ERROR_MEMORY. */
knurl_result knurl_broad_phase_add(knurl_broad_phase *phase, knurl_surface_data *surface, double time);

/* Swaps a surface's record for a new one, with its box valid throughout. Also before the commit. */
void knurl_broad_phase_publish(knurl_broad_phase *phase, knurl_surface_data *surface, knurl_record *record,
                               double time);

/* Puts a surface in the place of another, which is released once no tick can see it. Also before the commit. */
void knurl_broad_phase_replace(knurl_broad_phase *phase, knurl_surface_data *old, knurl_surface_data *made);

/* Removes a surface, and releases it once no tick can see it. Also before the commit. */
void knurl_broad_phase_remove(knurl_broad_phase *phase, knurl_surface_data *surface);

/* A query. */
typedef struct knurl_broad_query {
    const double *low; /* a box, scene axes, m */
    const double *high;
    double time;  /* s: of a motion that is over by then only its end counts */
    int test_all; /* 1: search without the hierarchy */
    int exact;    /* 1: without the margin around moving surfaces */
} knurl_broad_query;

/* Finds the places of the surfaces whose boxes meet a query's. Writes at most `limit` of them; returns their number, at
 * most limit + 1. Allowed in a tick. */
uint32_t knurl_broad_phase_find(const knurl_broad_index *index, const knurl_broad_query *query, uint32_t limit,
                                uint32_t *places) KNURL_NONBLOCKING;

#endif

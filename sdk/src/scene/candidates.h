/* The surfaces that one HIP may touch: a short list, and how far the HIP can move before it must be tested against
 * them.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_CANDIDATES_H
#define KNURL_SRC_CANDIDATES_H

#include "base/atomic.h"
#include "base/vec3.h"
#include "contact/facet.h"
#include "scene/broad_phase.h"
#include "scene/hip_clock.h"
#include "scene/pose.h"
#include "scene/wall.h"

/* Surfaces near a HIP that are looked at in a tick, at most. */
#define KNURL_CANDIDATES_MAX 32

/* One surface near a HIP, and all that is kept of it from tick to tick. */
typedef struct knurl_candidate {
    uint32_t place;
    uint32_t generation;
    uint32_t in_contact;
    uint32_t has_previous; /* 1: it was looked at in the last tick, so that `previous` and `jumps` hold */
    uint64_t jumps;        /* the motion's, at the last tick */
    double previous[3];    /* the HIP at the last tick, shape's frame */
    knurl_contact_state contact;
    knurl_grating_state grating;
    knurl_wall_state guard;
    double proxy[3]; /* of the latest contact, scene axes */
    double normal[3];
    float box[6];                 /* scene axes; outside it there is no contact */
    float swept[6];               /* scene axes: what the motion of this record sweeps, with its crests; no room */
    const knurl_record *swept_of; /* or null; its motion's start and its reach, for a record in freed memory: */
    double swept_start, swept_reach;
    uint64_t swept_tick; /* the tick at which `swept` was looked at last */
    double anchor[3];    /* friction: where the HIP sticks, shape's frame */
    knurl_facet facet;
    const knurl_motion *settled; /* what stood still, when it had begun, and from which tick on; or null */
    double settled_start;
    uint64_t settled_tick;
    uint64_t placed, placed_jumps; /* the tick at which it was seen last (0: none), and the motion's jumps then */
    uint32_t latest;     /* its pose then, of these: this tick's and the last one's, whatever has moved it between */
    knurl_pose poses[2]; /* of the shape's frame, scene */
} knurl_candidate;

/* No farther than `distance` (m, each axis) from `at`, the list is complete and the HIP comes into no box but those of
 * what it is in contact with; nor does its proxy, no farther from `proxy`. */
typedef struct knurl_clearance {
    double at[3];
    double proxy[3];
    double distance; /* below 0: unknown */
} knurl_clearance;

typedef struct knurl_candidates {
    double low[3]; /* the list is complete while the HIP stays in this box, scene axes, */
    double high[3];
    double depth;     /* is pressed no deeper than this, m, */
    uint64_t version; /* and the broad phase's version is this; 0: look again */
    uint32_t count;
    uint32_t overflow; /* 1: there were more than fit */
    knurl_clearance clearance;
    knurl_candidate list[KNURL_CANDIDATES_MAX];
} knurl_candidates;

/* How a HIP goes in one tick. */
typedef struct knurl_hip_path {
    const double *from; /* scene, m; at a first tick: `to` */
    const double *to;
    const double *proxy; /* scene, m: at the last tick */
    double depth;        /* m: of the deepest contact at the latest tick; 0 without */
    double time;         /* s */
    int is_first;        /* 1: a first tick */
    int everything;      /* 1: look at every surface at every tick (KNURL_FULL_SEARCH) */
} knurl_hip_path;

/* Empties the list. */
void knurl_candidates_reset(knurl_candidates *candidates) KNURL_NONBLOCKING;

/* Makes the list complete for a path, where it is not yet. */
void knurl_candidates_update(knurl_candidates *candidates, const knurl_broad_phase *phase,
                             const knurl_broad_index *index, const knurl_hip_path *path) KNURL_NONBLOCKING;

/* 1: the list is complete and nothing but what is in contact has to be looked at: so it is in most ticks. depth: m, of
 * the deepest contact. */
static inline int knurl_candidates_are_clear(const knurl_candidates *c, const knurl_broad_phase *phase,
                                             const double p[3], double depth) {
    const knurl_clearance *clear = &c->clearance;
    return (fabs(p[0] - clear->at[0]) < clear->distance) & (fabs(p[1] - clear->at[1]) < clear->distance) &
           (fabs(p[2] - clear->at[2]) < clear->distance) & (depth <= c->depth) &
           (c->version == knurl_load_acquire(&phase->version));
}

/* 1: nor does a proxy that is at p now. */
static inline int knurl_candidates_are_clear_of(const knurl_candidates *c, const double p[3]) {
    const knurl_clearance *clear = &c->clearance;
    return (fabs(p[0] - clear->proxy[0]) < clear->distance) & (fabs(p[1] - clear->proxy[1]) < clear->distance) &
           (fabs(p[2] - clear->proxy[2]) < clear->distance);
}

/* The poses of a candidate's frame at this tick and at the last: as they were seen then, if they were. One and the same
 * where it stands still. Valid in this tick, while the list stays as it is. */
void knurl_candidate_place(knurl_candidate *candidate, const knurl_motion *motion, const knurl_hip_clock *clock,
                           const knurl_pose **now, const knurl_pose **before) KNURL_NONBLOCKING;

/* 1: a path, with its proxy, comes into the candidate's box, or within `margin` (m) of it. */
int knurl_candidate_is_near(const knurl_candidate *candidate, const knurl_hip_path *path,
                            double margin) KNURL_NONBLOCKING;

/* The same for the box of what its surface's motion sweeps, which is smaller where the surface moves. 1 also where it
 * was not looked at in the last tick. */
int knurl_candidate_is_swept_near(knurl_candidate *candidate, const knurl_surface_data *surface,
                                  const knurl_hip_clock *clock, const knurl_hip_path *path,
                                  double margin) KNURL_NONBLOCKING;

/* The clearance at a position and a proxy, from the candidates that are not in contact. again: 1 where the next tick
 * has to look at all of them in any case. */
void knurl_candidates_measure(knurl_candidates *candidates, const double position[3], const double proxy[3],
                              int again) KNURL_NONBLOCKING;

#endif

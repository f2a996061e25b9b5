/* One surface near a HIP: where it stands in a tick, and whether the HIP comes near it. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_CANDIDATE_H
#define KNURL_SRC_CANDIDATE_H

#include "base/base.h"
#include "base/vec3.h"
#include "contact/facet.h"
#include "guard/wall.h"
#include "proxy/hip_clock.h"
#include "surface/pose.h"
#include "surface/surface.h"

/* One surface near a HIP, and all that is kept of it from tick to tick: first what every tick with a contact uses, so
 * that it takes few cache lines. */
typedef struct knurl_candidate {
    uint32_t place;
    uint32_t generation;
    uint32_t in_contact;
    uint32_t has_previous;         /* 1: it was looked at in the last tick, so that `previous` and `jumps` hold */
    uint32_t is_late;              /* 1: its search was cut short since, and `previous` is where the HIP was before */
    uint32_t latest;               /* which of `poses` was placed last */
    uint64_t jumps;                /* the motion's, at the last tick */
    double previous[3];            /* the HIP at the last tick, shape's frame */
    uint64_t placed, placed_jumps; /* the tick at which it was seen last (0: none), and the motion's jumps then */
    const knurl_motion *settled;   /* what stood still, when it had begun, and from which tick on; or null */
    double settled_start;
    uint64_t settled_tick;
    knurl_contact_state contact;
    knurl_grating_state grating;
    knurl_wall_state guard;
    double proxy[3]; /* of the latest contact, scene axes */
    double normal[3];
    double anchor[3];             /* friction: where the HIP sticks, shape's frame */
    float box[6];                 /* scene axes; outside it there is no contact */
    float swept[6];               /* scene axes: what the motion of this record sweeps, with its crests; no margin */
    const knurl_record *swept_of; /* or null; its motion's start and its reach, for a record in freed memory: */
    double swept_start, swept_reach;
    uint64_t swept_tick; /* the tick at which `swept` was looked at last */
    knurl_pose poses[2]; /* of the shape's frame, scene: this tick's and the last one's, whatever moved it between */
    knurl_part part;     /* holds while has_previous and `jumps` do */
    knurl_facet facet;
} knurl_candidate;

/* How a HIP goes in one tick. */
typedef struct knurl_hip_path {
    const double *from; /* scene, m; at a first tick: `to` */
    const double *to;
    const double *proxy; /* scene, m: at the last tick */
    double depth;        /* m: of the deepest contact at the latest tick; 0 without */
    double time;         /* s */
    int is_first;        /* 1: a first tick */
    int everything;      /* 1: look at every surface at every tick (KNURL_FULL_SEARCH) */
    double low[3];       /* the box of all three, by knurl_hip_path_bound() */
    double high[3];
} knurl_hip_path;

static inline void knurl_hip_path_bound(knurl_hip_path *path) {
    for (int i = 0; i < 3; i++) {
        path->low[i] = knurl_min(path->proxy[i], knurl_min(path->from[i], path->to[i]));
        path->high[i] = knurl_max(path->proxy[i], knurl_max(path->from[i], path->to[i]));
    }
}

/* What is not as simple: called by knurl_candidate_place(). */
void knurl_candidate_place_anew(knurl_candidate *candidate, const knurl_motion *motion, const knurl_hip_clock *clock,
                                const knurl_pose **now, const knurl_pose **before) KNURL_NONBLOCKING;

/* 1 where a candidate stood still at the last tick, and still does: its pose is motion->end. The usual tick of
 * knurl_candidate_place(). */
static inline int knurl_candidate_stands(knurl_candidate *c, const knurl_motion *motion, const knurl_hip_clock *clock) {
    if (KNURL_LIKELY(c->placed + 1 == clock->tick && c->settled == motion && c->settled_start == motion->start_time &&
                     c->settled_tick < clock->tick)) {
        c->placed = clock->tick;
        return 1;
    }
    return 0;
}

/* The poses of a candidate's frame at this tick and at the last: as they were seen then, if they were. One and the same
 * where it stands still. Valid in this tick, while the list stays as it is. */
static inline void knurl_candidate_place(knurl_candidate *c, const knurl_motion *motion, const knurl_hip_clock *clock,
                                         const knurl_pose **now, const knurl_pose **before) {
    if (knurl_candidate_stands(c, motion, clock)) {
        *now = *before = &motion->end;
    } else {
        knurl_candidate_place_anew(c, motion, clock, now, before);
    }
}

/* 1: a path, with its proxy, comes into the candidate's box, or within `margin` (m) of it. */
int knurl_candidate_is_near(const knurl_candidate *candidate, const knurl_hip_path *path,
                            double margin) KNURL_NONBLOCKING;

/* The same for the box of what its surface's motion sweeps, which is smaller where the surface moves. 1 also where it
 * was not looked at in the last tick. */
int knurl_candidate_is_swept_near(knurl_candidate *candidate, const knurl_surface_data *surface,
                                  const knurl_hip_clock *clock, const knurl_hip_path *path,
                                  double margin) KNURL_NONBLOCKING;

#endif

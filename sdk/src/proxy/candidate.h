/* One surface near a HIP: its pose in a tick, and whether the HIP comes near it. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_CANDIDATE_H
#define KNURL_SRC_CANDIDATE_H

#include "base/base.h"
#include "base/vec3.h"
#include "contact/facet.h"
#include "contact/projection.h"
#include "guard/hip_facts.h"
#include "guard/wall.h"
#include "proxy/hip_clock.h"
#include "surface/pose.h"
#include "surface/surface.h"

/* One surface near a HIP, and all that is kept of it from tick to tick. Members that every tick with a contact reads
 * come first, so that such a tick touches few cache lines. */
typedef struct knurl_candidate {
    uint32_t place;
    uint32_t generation;
    uint32_t in_contact;
    uint32_t has_previous;         /* 1: tested in the last tick, so `previous` and `jumps` are valid */
    uint32_t is_late;              /* 1: the last search ran out of visits, so `previous` is from an earlier tick */
    uint32_t latest;               /* index in `poses` of the last one computed */
    uint64_t jumps;                /* of the motion, at the last tick */
    double previous[3];            /* the HIP at the last tick, shape's frame */
    uint64_t placed, placed_jumps; /* tick of the last placement (0: never), and the motion's jumps then */
    const knurl_motion *settled;   /* a motion found at rest, or null; its start and the tick of finding it */
    double settled_start;
    uint64_t settled_tick;
    knurl_contact_state contact;
    knurl_grating_state grating;
    knurl_grating plays; /* the grating of the record with `plays_edits`, but for its amplitude */
    uint64_t plays_edits;
    knurl_wall_state wall;
    double proxy[3];    /* of the last contact, scene axes */
    double normal[3];   /* unit, scene axes */
    uint32_t is_unfelt; /* 1: a smooth mesh's triangles, but not its surface, were in contact at the last tick */
    double anchor[3];   /* friction: the point where the HIP sticks, shape's frame */
    knurl_projection_carry carry; /* of projected coordinates */
    float box[6];                 /* scene axes; there is no contact outside it */
    float swept[6];               /* scene axes: swept by the motion of a record, with crests, without margin */
    uint64_t swept_edits;         /* that record's `edits` */
    uint64_t swept_tick;          /* tick in which `swept` was last tested */
    knurl_pose poses[2];          /* of the shape's frame, scene: this tick's and the last one's, as seen then */
    knurl_part part;              /* valid while has_previous and `jumps` are */
    knurl_facet facet;
} knurl_candidate;

/* A HIP's path in one tick. */
typedef struct knurl_hip_path {
    const double *from; /* scene, m; in a first tick: `to` */
    const double *to;
    const double *proxy; /* scene, m: at the last tick */
    double depth;        /* m: of the deepest contact at the last tick; 0 without contact */
    double time;         /* s */
    int is_first;        /* 1: first tick: `from` is unknown */
    int test_all;        /* 1: test every surface in every tick (KNURL_FULL_SEARCH) */
    double low[3];       /* bounding box of all three, set by knurl_hip_path_bound() */
    double high[3];
} knurl_hip_path;

static inline void knurl_hip_path_bound(knurl_hip_path *path) {
    for (int i = 0; i < 3; i++) {
        path->low[i] = knurl_min(path->proxy[i], knurl_min(path->from[i], path->to[i]));
        path->high[i] = knurl_max(path->proxy[i], knurl_max(path->from[i], path->to[i]));
    }
}

/* Slow path of knurl_candidate_place(). */
void knurl_candidate_place_anew(knurl_candidate *candidate, const knurl_motion *motion, const knurl_hip_clock *clock,
                                const knurl_pose **now, const knurl_pose **before) KNURL_NONBLOCKING;

/* Fast path of knurl_candidate_place(): returns 1 if the surface stood still in the last tick and still does. Its pose
 * is motion->end. */
static inline int knurl_candidate_stands(knurl_candidate *c, const knurl_motion *motion, const knurl_hip_clock *clock) {
    if (KNURL_LIKELY(c->placed + 1 == clock->tick && c->settled == motion && c->settled_start == motion->start_time)) {
        c->placed = clock->tick;
        return 1;
    }
    return 0;
}

/* Poses of a candidate's frame in this tick and in the last: the one that the last tick used, if the candidate was
 * placed then. Both are the same pointer if the surface stands still. Valid in this tick, until the list changes. */
static inline void knurl_candidate_place(knurl_candidate *c, const knurl_motion *motion, const knurl_hip_clock *clock,
                                         const knurl_pose **now, const knurl_pose **before) {
    if (knurl_candidate_stands(c, motion, clock)) {
        *now = *before = &motion->end;
    } else {
        knurl_candidate_place_anew(c, motion, clock, now, before);
    }
}

/* 1 if a path or its proxy comes within `margin` (m) of the candidate's box. */
int knurl_candidate_is_near(const knurl_candidate *candidate, const knurl_hip_path *path,
                            double margin) KNURL_NONBLOCKING;

/* The same test against the box that the surface's motion sweeps, which is smaller if the surface moves. Also returns 1
 * if the candidate was not tested in the last tick. */
int knurl_candidate_is_swept_near(knurl_candidate *candidate, const knurl_surface_data *surface,
                                  const knurl_hip_clock *clock, const knurl_hip_path *path,
                                  double margin) KNURL_NONBLOCKING;

/* After an edit: prepares the record's grating, but for its amplitude. */
void knurl_candidate_set_grating(knurl_candidate *candidate, const knurl_record *record,
                                 const knurl_hip_facts *facts) KNURL_NONBLOCKING;

/* Ends its contact, if there is one. */
void knurl_candidate_end_contact(knurl_candidate *candidate) KNURL_NONBLOCKING;

/* Slow path of knurl_candidate_surface(): another surface, or none, is in its place. */
void knurl_candidate_note_change(knurl_candidate *candidate, const knurl_surface_data *surface) KNURL_NONBLOCKING;

#endif

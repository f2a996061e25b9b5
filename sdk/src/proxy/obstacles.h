/* The surfaces near a HIP as they stand in one tick, and casts among them. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_OBSTACLES_H
#define KNURL_SRC_OBSTACLES_H

#include "proxy/candidates.h"
#include "surface/surface.h"

/* One surface in one tick. */
typedef struct knurl_obstacle {
    knurl_candidate *candidate;
    const knurl_surface_data *surface;
    const knurl_record *record;
    const knurl_pose *pose;   /* of the shape's frame, now */
    const knurl_pose *before; /* a tick ago; the same pointer if it stands still */
} knurl_obstacle;

typedef struct knurl_obstacles {
    uint32_t count;
    int32_t moving;       /* 1: at least one moves in the tick */
    knurl_visits *visits; /* budget of casts */
    knurl_obstacle list[KNURL_CANDIDATES_MAX];
} knurl_obstacles;

/* No obstacle. */
#define KNURL_NO_OBSTACLE UINT32_MAX

/* Sets an obstacle up with its poses in this tick and the last. */
void knurl_obstacle_set(knurl_obstacle *obstacle, knurl_candidate *candidate, const knurl_surface_data *surface,
                        const knurl_record *record, const knurl_hip_clock *clock) KNURL_NONBLOCKING;

/* 1 if the surface has jumped since the HIP's last tick. */
static inline int knurl_obstacle_has_jumped(const knurl_obstacle *o) {
    return o->candidate->has_previous && o->candidate->jumps != o->record->motion.jumps;
}

/* 1 if the segment, or a point within `distance` (m) of its ends, is near enough to the shape's own bounds for contact.
 * These bounds rotate with the surface and are tighter than its box in the scene. */
int knurl_obstacle_is_near(const knurl_obstacle *obstacle, const double from[3], const double to[3],
                           double distance) KNURL_NONBLOCKING;

/* A point's straight path; scene, m. */
typedef struct knurl_segment {
    const double *from;
    const double *to;
    int32_t moving;  /* 0: all surfaces as they stand now; 1: the path takes the whole tick, in which they move */
    uint32_t except; /* index of an obstacle to skip, or KNURL_NO_OBSTACLE */
} knurl_segment;

/* 1 if the visits have run out: results of casts since then are not valid. */
static inline int knurl_obstacles_are_unknown(const knurl_obstacles *obstacles) {
    return obstacles->visits->left == 0;
}

/* Finds the first obstacle whose face a segment crosses from the front. Returns its index and the hit in its frame, or
 * KNURL_NO_OBSTACLE. */
uint32_t knurl_obstacles_cast(const knurl_obstacles *obstacles, const knurl_segment *segment,
                              knurl_cast_hit *hit) KNURL_NONBLOCKING;

/* 1 if the segment certainly crosses no face. */
static inline int knurl_obstacles_are_clear(const knurl_obstacles *obstacles, const knurl_segment *segment) {
    knurl_cast_hit hit;
    return knurl_obstacles_cast(obstacles, segment, &hit) == KNURL_NO_OBSTACLE &&
           !knurl_obstacles_are_unknown(obstacles);
}

#endif

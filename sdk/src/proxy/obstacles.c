/* Casts among surfaces, each in its own frame. SPDX-License-Identifier: MIT */
#include "proxy/obstacles.h"

#include <string.h>

void knurl_obstacle_set(knurl_obstacle *o, knurl_candidate *candidate, const knurl_surface_data *surface,
                        const knurl_record *record, const knurl_hip_clock *clock) {
    o->candidate = candidate;
    o->surface = surface;
    o->record = record;
    if (!candidate->has_previous || candidate->jumps != record->motion.jumps) { /* it may be another shape */
        knurl_part_clear(&candidate->part);
    }
    knurl_candidate_place(candidate, &record->motion, clock, &o->pose, &o->before);
}

int knurl_obstacle_is_near(const knurl_obstacle *o, const double from[3], const double to[3], double distance) {
    const knurl_shape *shape = &o->surface->shape;
    const double margin = distance + o->record->reach + shape->seam + KNURL_CAST_SLACK;
    double before[3], now[3];
    knurl_pose_to_own(o->before, from, before);
    knurl_pose_to_own(o->pose, to, now);
    for (int i = 0; i < 3; i++) {
        const double low = shape->low[i] - margin, high = shape->high[i] + margin;
        if (((now[i] < low) & (before[i] < low)) | ((now[i] > high) & (before[i] > high))) {
            return 0;
        }
    }
    return 1;
}

/* 1 if the box from low to high is outside the candidate's, which bounds the surface with its crests and margin; faces
 * reach beyond it by a seam. */
static int is_beside(const knurl_obstacle *o, const double low[3], const double high[3]) {
    const float *box = o->candidate->box;
    const double margin = o->surface->shape.seam + KNURL_CAST_SLACK;
    for (int i = 0; i < 3; i++) {
        if (high[i] < (double)box[i] - margin || low[i] > (double)box[3 + i] + margin) {
            return 1;
        }
    }
    return 0;
}

/* m: height of a point above a plane with this pose. */
static double height_over(const knurl_pose *pose, const double p[3]) {
    const double *r = pose->rotation;
    double to[3];
    vec3_sub(p, pose->position, to);
    return pose->is_rotated ? r[2] * to[0] + r[5] * to[1] + r[8] * to[2] : to[2];
}

/* m: above the rounding of heights, and above a cast's slack. */
#define HEIGHT_ROUNDING (2.0 * KNURL_CAST_SLACK)

/* 1 if a segment, up to a share of its length, does not cross the plane from a side that can be felt. */
static int misses_plane(const knurl_obstacle *o, const knurl_segment *segment, double share) {
    const double from = height_over(segment->moving ? o->before : o->pose, segment->from);
    const double to = from + share * (height_over(o->pose, segment->to) - from);
    const int misses_front = from < -HEIGHT_ROUNDING || to > HEIGHT_ROUNDING;
    const int misses_back = from > HEIGHT_ROUNDING || to < -HEIGHT_ROUNDING;
    return misses_front && (misses_back || !o->surface->double_sided);
}

static int cast_at(const knurl_obstacle *o, const knurl_segment *segment, knurl_visits *visits, knurl_cast_hit *hit) {
    knurl_cast cast;
    cast.visits = visits;
    cast.part = &o->candidate->part;
    knurl_pose_to_own(segment->moving ? o->before : o->pose, segment->from, cast.from);
    knurl_pose_to_own(o->pose, segment->to, cast.to);
    cast.double_sided = o->surface->double_sided;
    return knurl_shape_cast(&o->surface->shape, &cast, hit);
}

uint32_t knurl_obstacles_cast(const knurl_obstacles *obstacles, const knurl_segment *segment, knurl_cast_hit *hit) {
    uint32_t first = KNURL_NO_OBSTACLE;
    double low[3], high[3];
    for (int i = 0; i < 3; i++) {
        low[i] = knurl_min(segment->from[i], segment->to[i]);
        high[i] = knurl_max(segment->from[i], segment->to[i]);
    }
    for (uint32_t i = 0; i < obstacles->count && !knurl_obstacles_are_unknown(obstacles); i++) {
        const knurl_obstacle *o = &obstacles->list[i];
        const double share = first == KNURL_NO_OBSTACLE ? 1.0 : hit->share; /* later hits do not matter */
        knurl_cast_hit found;
        if (i == segment->except || is_beside(o, low, high) || !knurl_visits_take(obstacles->visits, 1) ||
            (o->surface->shape.plane && misses_plane(o, segment, share))) {
            continue;
        }
        if (cast_at(o, segment, obstacles->visits, &found) &&
            (first == KNURL_NO_OBSTACLE || found.share < hit->share)) {
            first = i;
            *hit = found;
        }
    }
    return first;
}

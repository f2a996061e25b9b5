/* Begins, holds and ends contacts. Read knurl_contacts_find(), at the end, first. SPDX-License-Identifier: MIT */
#include "proxy/contact_update.h"

#include "base/base.h"
#include "proxy/joint_contact.h"

#include <string.h>

/* Queries one shape's contact with the HIP (hip: shape's frame). Returns 1 if it holds the HIP or is in reach. */
static inline int query_shape(knurl_contacts *c, knurl_active_contact *a, const double hip[3],
                              knurl_contact_state *state) {
    const knurl_shape *shape = &a->surface->shape;
    knurl_contact_query query;
    vec3_copy(hip, query.hip);
    vec3_copy(a->candidate->previous, query.previous);
    query.has_previous = c->has_previous;
    query.reach = a->record->reach;
    query.double_sided = a->surface->double_sided;
    query.facet = &a->candidate->facet;
    query.part = &a->candidate->part;
    query.visits = &c->budget.visits;
    return knurl_shape_contact(shape, &query, state, &a->contact);
}

/* 1 if nothing else can be near a surface's proxy (scene): it is within `margin` (m) of the last tick's proxy or, if
 * that is null, within the clearance. */
static inline int is_within_view(const knurl_contacts *c, const double *margin, const double proxy[3]) {
    if (KNURL_LIKELY(!margin)) {
        return knurl_candidates_are_clear_of(&c->candidates, proxy);
    }
    return vec3_distance2(c->proxy.holders ? c->proxy.at : c->previous, proxy) <= *margin * *margin;
}

/* Stage 1 of hold_alone(): the candidate's surface and its pose in this tick. Returns 0 if it was removed, has jumped,
 * or was not tested in the last tick. */
static inline int place_alone(knurl_contacts *c, const knurl_broad_index *index, knurl_active_contact *a) {
    knurl_candidate *candidate = a->candidate;
    const knurl_pose *before;
    if (KNURL_LIKELY(knurl_contact_is_steady(a, index))) { /* as in the last tick, also its pose */
        candidate->placed = c->clock.tick;
        return 1;
    }
    a->surface = knurl_candidate_surface(index, candidate);
    if (KNURL_UNLIKELY(!a->surface)) {
        return 0;
    }
    a->record = __atomic_load_n(&a->surface->record, __ATOMIC_SEQ_CST);
    const knurl_motion *motion = &a->record->motion;
    if (KNURL_UNLIKELY(!candidate->has_previous || candidate->jumps != motion->jumps)) {
        return 0; /* also if it stands: joint contact may have placed a replaced surface without testing it */
    }
    if (KNURL_LIKELY(knurl_candidate_stands(candidate, motion, &c->clock))) {
        a->pose = &motion->end;
        return 1;
    }
    knurl_contacts_catch_up(c, motion);
    knurl_candidate_place_anew(candidate, motion, &c->clock, &a->pose, &before);
    return 1;
}

/* Tests only `candidate`, the last tick's only contact, if nothing else is near the HIP. Returns 0, with the contact
 * unchanged, if joint contact has to decide; the cache then holds the query's result. margin: as for is_within_view().
 */
static inline int hold_alone(knurl_contacts *c, const knurl_broad_index *index, knurl_candidate *candidate,
                             const double position[3], const double *margin) {
    knurl_active_contact *a = &c->now.list[0];
    knurl_contact_state *state = &candidate->contact;
    double hip[3], proxy[3], normal[3];
    if (!place_alone(c, index, a)) {
        return 0;
    }
    knurl_pose_to_own(a->pose, position, hip);
    const knurl_plane *plane = a->surface->shape.plane;
    const int held_by_plane = plane && knurl_plane_hold(plane, hip, state, &a->contact);
    const knurl_contact_state before = *state;
    const int held = held_by_plane || query_shape(c, a, hip, state);
    const int is_settled = held && !a->contact.unsure && c->budget.visits.left > 0;
    if (KNURL_LIKELY(is_settled)) {
        knurl_pose_to_parent(a->pose, a->contact.proxy, proxy);
        knurl_pose_vector_to_parent(a->pose, a->contact.normal, normal);
    }
    if (KNURL_UNLIKELY(!is_settled) || (state->inside && KNURL_UNLIKELY(!is_within_view(c, margin, proxy)))) {
        if (!held_by_plane) {
            c->cache.of = candidate;
            c->cache.result.held = held;
            c->cache.result.state = *state;
            c->cache.result.contact = a->contact;
            c->cache.result.parts.count = 0;
            *state = before;
        }
        return 0;
    }
    vec3_copy(proxy, candidate->proxy);
    vec3_copy(normal, candidate->normal);
    vec3_copy(hip, candidate->previous);
    a->normal = candidate->normal;
    a->steady = a->pose == &a->record->motion.end ? a->record->edits : 0;
    a->slides = a->steady && state->inside && (plane ? !plane->outline : a->contact.facet == &candidate->facet);
    a->seam = a->surface->shape.seam;
    a->begins = a->is_unfelt = 0;
    a->share = a->friction_share = 1.0;
    a->felt.parts.count = 0;
    c->now.count = 1;
    c->proxy.holders = (uint32_t)state->inside;
    if (KNURL_LIKELY(state->inside)) {
        vec3_madd(proxy, a->surface->shape.seam, normal, c->proxy.at);
        vec3_copy(normal, c->proxy.normal);
        c->proxy.depth = fabs(a->contact.z);
    } else {
        vec3_copy(position, c->proxy.at);
        c->proxy.depth = 0.0;
    }
    return 1;
}

void knurl_contacts_init(knurl_contacts *c, double period, double time) {
    memset(c, 0, sizeof *c);
    c->clock.period = period;
    c->clock.time = time;
    c->budget.max = KNURL_VISITS_MAX;
    knurl_contacts_reset(c);
}

void knurl_contacts_reset(knurl_contacts *c) {
    knurl_candidates_reset(&c->candidates);
    c->has_previous = 0;
    c->proxy.depth = 0.0;
    c->now.count = 0;
    c->proxy.holders = 0;
    c->slip.time = -1.0;
}

/* 1 if the path comes near a candidate that is not in contact. */
static int comes_near(const knurl_contacts *c, const knurl_broad_index *index, knurl_candidate *candidate,
                      const knurl_hip_path *path, double margin) {
    if (!knurl_candidate_is_near(candidate, path, margin)) {
        return 0;
    }
    const knurl_surface_data *surface = knurl_candidate_surface(index, candidate);
    return surface && knurl_candidate_is_swept_near(candidate, surface, &c->clock, path, margin);
}

/* The candidate in contact, if it is the only one and the path comes near no other; else null. */
static knurl_candidate *find_alone(knurl_contacts *c, const knurl_broad_index *index, const knurl_hip_path *path,
                                   double margin) {
    knurl_candidate *alone = c->now.list[0].candidate;
    if (c->now.count != 1 || c->proxy.holders > 1 || path->is_first || path->test_all ||
        knurl_contacts_have_slipped(c)) {
        return NULL;
    }
    for (uint32_t i = 0; i < c->candidates.count; i++) {
        knurl_candidate *candidate = knurl_candidates_at(&c->candidates, i);
        if (candidate != alone && (candidate->in_contact || comes_near(c, index, candidate, path, margin))) {
            return NULL;
        }
    }
    return alone->in_contact ? alone : NULL;
}

/* m: distance within which the HIP may meet other surfaces: its depth or, after a slip off a rim, that to the rim. */
static double find_depth(const knurl_contacts *c, const double position[3]) {
    return knurl_contacts_have_slipped(c) ? knurl_max(c->proxy.depth, sqrt(vec3_distance2(c->slip.proxy, position)))
                                          : c->proxy.depth;
}

/* The HIP's path in this tick. */
static knurl_hip_path find_path(const knurl_contacts *c, const double position[3]) {
    knurl_hip_path path = {.from = c->has_previous ? c->previous : position,
                           .to = position,
                           .proxy = c->proxy.holders ? c->proxy.at : position,
                           .depth = find_depth(c, position),
                           .time = c->clock.time,
                           .is_first = !c->has_previous,
                           .test_all = c->test_all};
    knurl_hip_path_bound(&path);
    return path;
}

/* Completes the list when there is no clearance. Returns find_alone(). *margin: m, for hold_alone(). */
__attribute__((noinline)) static knurl_candidate *update_candidates(knurl_contacts *c, const knurl_broad_phase *phase,
                                                                    const knurl_broad_index *index,
                                                                    const double position[3], double *margin) {
    const knurl_hip_path path = find_path(c, position);
    *margin = knurl_hip_path_margin(&path);
    knurl_candidates_update(&c->candidates, phase, index, &path);
    return find_alone(c, index, &path, *margin);
}

/* Measures the clearance of a HIP that is in contact with `alone` only. */
static void measure_alone(knurl_contacts *c, const knurl_candidate *alone, const double position[3]) {
    for (uint32_t i = 0; i < c->candidates.count; i++) {
        knurl_candidate *candidate = knurl_candidates_at(&c->candidates, i);
        candidate->has_previous &= candidate == alone;
    }
    knurl_candidates_measure(&c->candidates, position, c->proxy.at, 0);
}

/* A tick of joint contact with at most this many visits had little to do. */
#define FEW_VISITS 4

/* Finds contact with several surfaces. */
__attribute__((noinline)) static void find_jointly(knurl_contacts *c, const knurl_broad_phase *phase,
                                                   const knurl_broad_index *index, const double position[3],
                                                   uint32_t *flags) {
    const knurl_hip_path path = find_path(c, position);
    const uint32_t before = c->now.count;
    c->proxy.ramped_depth = knurl_contacts_have_slipped(c) ? c->slip.ramped_depth : 0.0;
    for (uint32_t i = 0; i < c->candidates.count && c->proxy.holders; i++) {
        const knurl_candidate *candidate = knurl_candidates_at(&c->candidates, i);
        c->proxy.ramped_depth = candidate->in_contact && candidate->wall.depth > c->proxy.ramped_depth
                                    ? candidate->wall.depth
                                    : c->proxy.ramped_depth;
    }
    knurl_joint_contact(c, index, &path, flags);
    c->cache.of = NULL;
    c->proxy.depth = c->proxy.holders ? sqrt(vec3_distance2(c->proxy.at, position)) : 0.0;
    if (c->proxy.holders && knurl_visits_of(c->budget.max).left - c->budget.visits.left <= FEW_VISITS) {
        knurl_candidates_look_ahead(&c->candidates, phase, index, &path);
    }
    knurl_candidates_measure(&c->candidates, position, c->proxy.at, c->now.count < before || c->test_all);
}

void knurl_contacts_find(knurl_contacts *c, const knurl_broad_phase *phase, const knurl_broad_index *index,
                         const double position[3], int clear, uint32_t *flags) {
    double margin;
    knurl_active_contact *first = &c->now.list[0];
    if (c->now.count == 1 && first->slides) { /* knurl_contacts_slide() left it behind */
        vec3_madd(first->candidate->proxy, first->seam, first->candidate->normal, c->proxy.at);
    }
    c->budget.visits = knurl_visits_of(c->budget.max);
    knurl_candidate *alone = KNURL_LIKELY(clear && c->now.count == 1) ? c->now.list[0].candidate : NULL;
    if (KNURL_UNLIKELY(!clear)) {
        alone = update_candidates(c, phase, index, position, &margin);
    }
    if (KNURL_UNLIKELY(!alone || !hold_alone(c, index, alone, position, clear ? NULL : &margin))) {
        find_jointly(c, phase, index, position, flags);
    } else if (KNURL_UNLIKELY(!clear)) {
        measure_alone(c, alone, position);
    }
    if (KNURL_UNLIKELY(c->candidates.overflow)) {
        *flags |= KNURL_TICK_CONTACTS_FULL;
    }
    if (KNURL_UNLIKELY(c->budget.visits.exhausted)) {
        c->budget.short_ticks += c->budget.short_ticks < 5;
        *flags |= KNURL_TICK_VISIT_LIMIT;
    } else {
        c->budget.short_ticks = 0;
    }
}

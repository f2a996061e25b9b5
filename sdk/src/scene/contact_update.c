/* Begins, holds and ends contacts. Read knurl_contacts_update(), at the end, first. SPDX-License-Identifier: MIT */
#include "scene/contact_update.h"

#include "scene/joint_contact.h"

#include <string.h>

/* The HIP in the shape's frame, now and before. pose: of that frame, now. */
static void make_query(const knurl_contacts *c, const knurl_active_contact *a, const double position[3],
                       knurl_contact_query *query) {
    knurl_pose_to_own(a->pose, position, query->hip);
    vec3_copy(a->candidate->previous, query->previous);
    query->has_previous = c->has_previous;
    query->reach = a->record->reach;
    query->double_sided = a->surface->double_sided;
    query->facet = &a->candidate->facet;
}

/* Nothing but the one surface that is in contact is near: its shape alone is asked. 0 where that does not settle it,
 * and nothing has changed. */
static int hold_alone(knurl_contacts *c, const knurl_broad_index *index, const double position[3]) {
    knurl_active_contact *a = &c->active[0];
    knurl_candidate *candidate = a->candidate;
    const knurl_pose *before;
    knurl_contact_query query;
    knurl_contact_state state = candidate->contact;
    a->surface = knurl_contacts_surface(index, candidate);
    if (!a->surface) {
        return 0;
    }
    a->record = __atomic_load_n(&a->surface->record, __ATOMIC_SEQ_CST);
    const knurl_motion *motion = &a->record->motion;
    if (!candidate->has_previous || candidate->jumps != motion->jumps) {
        return 0;
    }
    knurl_contacts_catch_up(c, motion);
    knurl_candidate_place(candidate, motion, &c->clock, &a->pose, &before);
    make_query(c, a, position, &query);
    if (!knurl_shape_contact(&a->surface->shape, &query, &state, &a->contact) || a->contact.unsure) {
        return 0;
    }
    double proxy[3];
    double normal[3];
    knurl_pose_to_parent(a->pose, a->contact.proxy, proxy);
    knurl_pose_vector_to_parent(a->pose, a->contact.normal, normal);
    if (state.inside && !knurl_candidates_are_clear_of(&c->candidates, proxy)) {
        return 0;
    }
    vec3_copy(proxy, candidate->proxy);
    vec3_copy(normal, candidate->normal);
    vec3_copy(query.hip, candidate->previous);
    candidate->contact = state;
    a->begins = 0;
    c->active_count = 1;
    c->pressed = (uint32_t)state.inside;
    return 1;
}

void knurl_contacts_init(knurl_contacts *c, double period, double time) {
    memset(c, 0, sizeof *c);
    c->clock.period = period;
    c->clock.time = time;
    knurl_contacts_reset(c);
}

void knurl_contacts_reset(knurl_contacts *c) {
    knurl_candidates_reset(&c->candidates);
    c->has_previous = 0;
    c->depth = 0.0;
    c->active_count = 0;
    c->pressed = 0;
    c->slip.time = -1.0;
}

/* The proxy of the one surface that holds the HIP, for the next tick. */
static void keep_proxy(knurl_contacts *c, const double position[3]) {
    const knurl_candidate *candidate = c->active[0].candidate;
    if (c->pressed) {
        vec3_madd(candidate->proxy, c->active[0].surface->shape.seam, candidate->normal, c->proxy);
        vec3_copy(candidate->normal, c->normal);
        c->depth = fabs(c->active[0].contact.z);
    } else {
        vec3_copy(position, c->proxy);
        c->depth = 0.0;
    }
}

/* What is looked for at several surfaces. */
static void look_around(knurl_contacts *c, const knurl_broad_index *index, const knurl_hip_path *path,
                        uint32_t *flags) {
    const uint32_t before = c->active_count;
    c->ramped_depth = knurl_contacts_have_slipped(c) ? c->slip.ramped_depth : 0.0;
    for (uint32_t i = 0; i < c->candidates.count && c->pressed; i++) {
        const knurl_candidate *candidate = &c->candidates.list[i];
        c->ramped_depth = candidate->in_contact && candidate->guard.depth > c->ramped_depth ? candidate->guard.depth
                                                                                            : c->ramped_depth;
    }
    knurl_joint_contact(c, index, path, flags);
    c->depth = 0.0;
    if (c->pressed) {
        double way[3];
        vec3_sub(c->proxy, path->to, way);
        c->depth = vec3_length(way);
    }
    knurl_candidates_measure(&c->candidates, path->to, c->proxy, c->active_count < before || path->everything);
}

void knurl_contacts_update(knurl_contacts *c, const knurl_broad_phase *phase, const knurl_broad_index *index,
                           const double position[3], uint32_t *flags) {
    const int clear = c->has_previous && knurl_candidates_are_clear(&c->candidates, phase, position, c->depth);
    if (clear && c->active_count == 1 && hold_alone(c, index, position)) {
        keep_proxy(c, position);
    } else if (!clear || c->active_count > 0 || knurl_contacts_have_slipped(c)) {
        const double *proxy = c->pressed ? c->proxy : position;
        const knurl_hip_path path = {c->has_previous ? c->previous : position,
                                     position,
                                     proxy,
                                     c->depth,
                                     c->clock.time,
                                     !c->has_previous,
                                     c->everything};
        if (!clear) {
            knurl_candidates_update(&c->candidates, phase, index, &path);
        }
        look_around(c, index, &path, flags);
    }
    if (c->candidates.overflow) {
        *flags |= KNURL_TICK_CONTACTS_FULL;
    }
}

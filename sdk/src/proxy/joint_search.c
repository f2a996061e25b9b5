/* Collects the obstacles near a HIP in one tick, and queries each shape alone. SPDX-License-Identifier: MIT */
#include "proxy/joint_search.h"

#include <string.h>

/* m: largest distance of a path's proxy from its ends. */
static double proxy_distance(const knurl_hip_path *path) {
    return sqrt(knurl_max(vec3_distance2(path->proxy, path->from), vec3_distance2(path->proxy, path->to)));
}

/* Appends an obstacle; drops the query results from slot i on if that held another one. */
static void add_obstacle(knurl_joint_search *m, const knurl_obstacle *obstacle) {
    const uint32_t i = m->near.count++;
    m->queried = i < m->queried && m->near.list[i].candidate != obstacle->candidate ? i : m->queried;
    m->near.list[i] = *obstacle;
    m->near.moving |= obstacle->before != obstacle->pose;
    m->jumped |= obstacle->candidate->in_contact && knurl_obstacle_has_jumped(obstacle);
}

void knurl_joint_collect(knurl_joint_search *m, const knurl_hip_path *path, double margin) {
    knurl_contacts *c = m->contacts;
    const double reach = margin + proxy_distance(path);
    m->near.count = 0;
    m->near.moving = m->jumped = 0;
    for (uint32_t i = 0; i < c->candidates.count; i++) {
        knurl_candidate *candidate = knurl_candidates_at(&c->candidates, i);
        const knurl_surface_data *surface = NULL;
        knurl_obstacle o;
        if (candidate->in_contact || knurl_candidate_is_near(candidate, path, margin)) {
            surface = knurl_candidate_surface(m->index, candidate);
        }
        if (surface) {
            const knurl_record *record = __atomic_load_n(&surface->record, __ATOMIC_SEQ_CST);
            knurl_contacts_catch_up(c, &record->motion);
            knurl_obstacle_set(&o, candidate, surface, record, &c->clock);
        }
        if (surface && (candidate->in_contact || knurl_obstacle_is_near(&o, path->from, path->to, reach))) {
            add_obstacle(m, &o);
        } else {
            candidate->has_previous = 0;
        }
    }
    m->queried = m->queried < m->near.count ? m->queried : m->near.count;
}

void knurl_joint_collect_all(knurl_joint_search *m) {
    knurl_joint_collect(m, m->path, KNURL_JOINT_ROUNDING + proxy_distance(m->path));
}

/* Queries one shape alone for contact with a HIP at `hip`. previous: the HIP a tick ago (scene), or null: unknown. */
static void query_shape(const knurl_joint_search *m, const knurl_obstacle *o, const double hip[3],
                        const double *previous, knurl_touched *touched) {
    knurl_contact_query query;
    touched->parts.count = 0;
    query.has_previous = previous != NULL;
    query.reach = o->record->reach;
    query.double_sided = o->surface->double_sided;
    query.facet = &o->candidate->facet;
    query.part = &o->candidate->part;
    query.visits = &m->contacts->budget.visits;
    knurl_pose_to_own(o->pose, hip, query.hip);
    vec3_copy(query.hip, query.previous);
    if (previous && !touched->state.inside) { /* a HIP inside is tested at its position alone */
        knurl_pose_to_own(o->before, previous, query.previous);
        if (o->candidate->is_late && o->candidate->has_previous && previous == m->contacts->previous) {
            vec3_copy(o->candidate->previous, query.previous);
        }
    }
    touched->held = knurl_shape_contact(&o->surface->shape, &query, &touched->state, &touched->contact);
}

void knurl_joint_query_contact(knurl_joint_search *m, const knurl_obstacle *o, knurl_touched *touched) {
    const knurl_contacts *c = m->contacts;
    const int jumped = knurl_obstacle_has_jumped(o);
    const int anew = !c->has_previous || (jumped && o->candidate->in_contact);
    if (o->candidate == c->cache.of && !anew) {
        *touched = c->cache.result;
        return;
    }
    touched->state = o->candidate->contact;
    if (anew) {
        memset(&touched->state, 0, sizeof touched->state);
    }
    query_shape(m, o, m->hip, anew ? NULL : c->previous, touched);
}

void knurl_joint_query_jumped(const knurl_joint_search *m, const knurl_obstacle *o, knurl_touched *touched) {
    if (!touched->held && o->candidate->in_contact && o->surface->double_sided) {
        double from[3];
        vec3_madd(o->candidate->proxy, KNURL_CAPTURE_DEPTH, o->candidate->normal, from);
        memset(&touched->state, 0, sizeof touched->state);
        query_shape(m, o, m->hip, from, touched);
    }
}

void knurl_joint_query_crests(knurl_joint_search *m, const knurl_obstacle *o, knurl_touched *touched) {
    touched->held = 0;
    touched->state = o->candidate->contact;
    if (touched->state.inside) {
        memset(&touched->state, 0, sizeof touched->state);
    }
    if (m->pressed == 0 || o->record->reach > KNURL_ON_SURFACE) {
        query_shape(m, o, m->proxy, m->proxy, touched);
    }
    if (m->pressed > 0 && touched->held && touched->contact.z <= 2.0 * o->surface->shape.seam) {
        double normal[3];
        knurl_pose_vector_to_parent(o->pose, touched->contact.normal, normal);
        touched->held = vec3_dot(normal, m->normal) < 0.5;
    }
    touched->held &= !knurl_obstacles_are_unknown(&m->near);
    if (!touched->held) {
        memset(&touched->state, 0, sizeof touched->state);
    }
}

void knurl_joint_set_proxy(knurl_joint_search *m, uint32_t i) {
    const knurl_obstacle *o = &m->near.list[i];
    const knurl_contact *contact = &m->touched[i].contact;
    knurl_pose_to_parent(o->pose, contact->proxy, m->proxy);
    knurl_pose_vector_to_parent(o->pose, contact->normal, m->normal);
    vec3_madd(m->proxy, o->surface->shape.seam, m->normal, m->proxy);
    m->pressed = 1;
}

/* Contact with several surfaces. Read knurl_joint_contact(), at the end, first. While one surface alone holds the HIP
 * and nothing blocks the proxy, that surface's own contact is used; otherwise a god-object finds the faces that hold
 * the proxy together. SPDX-License-Identifier: MIT */
#include "proxy/joint_contact.h"

#include "proxy/god_object.h"
#include "proxy/joint_faces.h"

/* 1 if everything between `from` and the proxy has been collected. */
static int is_collected(const knurl_joint_search *m, const double from[3]) {
    return m->pressed == 0 || vec3_distance2(from, m->proxy) <= m->margin * m->margin;
}

/* Contact of a HIP that was free. Returns 1 if at most one shape begins contact and the path to its proxy is clear. */
static int begin_contact(knurl_joint_search *m) {
    uint32_t holder = KNURL_NO_OBSTACLE;
    knurl_joint_set_free(m);
    for (uint32_t i = 0; i < m->near.count; i++) {
        knurl_joint_query_contact(m, &m->near.list[i], &m->touched[i]);
        m->queried = i + 1;
        if (m->touched[i].contact.unsure || (knurl_joint_is_inside(&m->touched[i]) && holder != KNURL_NO_OBSTACLE) ||
            knurl_obstacles_are_unknown(&m->near)) {
            return 0;
        }
        holder = knurl_joint_is_inside(&m->touched[i]) ? i : holder;
    }
    if (holder == KNURL_NO_OBSTACLE) {
        return 1;
    }
    knurl_joint_set_proxy(m, holder);
    return is_collected(m, m->contacts->previous) &&
           knurl_god_object_can_go(&m->near, m->contacts->previous, m->normal, m->proxy, m->normal, holder);
}

/* The only surface that held the HIP in the last tick, or KNURL_NO_OBSTACLE. */
static uint32_t find_holder(const knurl_joint_search *m) {
    uint32_t holder = KNURL_NO_OBSTACLE;
    for (uint32_t i = 0; i < m->near.count && m->contacts->proxy.holders == 1; i++) {
        holder = m->near.list[i].candidate->contact.inside ? i : holder;
    }
    return holder;
}

/* Contact of a HIP that one surface held. Returns 1 if the proxy's path on it hits no other surface. */
static int continue_contact(knurl_joint_search *m) {
    const knurl_contacts *c = m->contacts;
    const uint32_t holder = find_holder(m);
    if (holder == KNURL_NO_OBSTACLE) {
        return 0;
    }
    knurl_touched *touched = &m->touched[holder];
    knurl_joint_query_contact(m, &m->near.list[holder], touched);
    m->queried = m->near.count == 1;
    const int unsure = touched->contact.unsure;
    if ((!touched->held && unsure) || knurl_obstacles_are_unknown(&m->near)) {
        return 0;
    }
    knurl_joint_set_free(m);
    if (knurl_joint_is_inside(touched)) {
        knurl_joint_set_proxy(m, holder);
    }
    if (!is_collected(m, c->proxy.at) ||
        !knurl_god_object_can_go(&m->near, c->proxy.at, c->proxy.normal, m->proxy,
                                 m->pressed ? m->normal : c->proxy.normal, unsure ? KNURL_NO_OBSTACLE : holder)) {
        return 0;
    }
    for (uint32_t i = 0; i < m->near.count; i++) {
        if (i != holder) {
            knurl_joint_query_crests(m, &m->near.list[i], &m->touched[i]);
        }
    }
    return 1;
}

/* The HIP's last position is unknown: tests each shape alone. A shape is not in contact if another face separates it
 * from the HIP. */
static void find_first(knurl_joint_search *m) {
    double deepest = 1.0;
    double proxy[3] = {0.0, 0.0, 0.0}, normal[3] = {0.0, 0.0, 0.0};
    uint32_t pressed = 0;
    for (uint32_t i = 0; i < m->near.count; i++) {
        knurl_touched *touched = &m->touched[i];
        knurl_joint_query_contact(m, &m->near.list[i], touched);
        if (knurl_obstacle_has_jumped(&m->near.list[i])) { /* its old contact ends */
            knurl_joint_query_jumped(m, &m->near.list[i], touched);
            knurl_candidate_end_contact(m->near.list[i].candidate);
        }
        if (!knurl_joint_is_inside(touched)) {
            continue;
        }
        knurl_joint_set_proxy(m, i);
        const knurl_segment way = {m->hip, m->proxy, 0, i};
        touched->held = knurl_obstacles_are_clear(&m->near, &way);
        pressed += (uint32_t)touched->held;
        if (touched->held && touched->contact.z < deepest) {
            deepest = touched->contact.z;
            vec3_copy(m->proxy, proxy);
            vec3_copy(m->normal, normal);
        }
    }
    knurl_joint_set_free(m);
    if (pressed > 0) {
        vec3_copy(proxy, m->proxy);
        vec3_copy(normal, m->normal);
        m->pressed = pressed;
    }
}

/* Repeats the last tick's contact; its proxy and normal move with the surface. */
static void keep_contact(const knurl_joint_search *m, const knurl_obstacle *o, knurl_touched *touched) {
    const knurl_candidate *candidate = o->candidate;
    const double reach = o->record->reach > KNURL_ON_SURFACE ? o->record->reach : KNURL_ON_SURFACE;
    const knurl_cast_hit hit = {.triangle = candidate->contact.triangle, .side = candidate->contact.side};
    knurl_contact *contact = &touched->contact;
    double at[3], hip[3];
    touched->held = candidate->in_contact && !knurl_obstacle_has_jumped(o);
    if (!touched->held) {
        return;
    }
    knurl_pose_to_own(o->before, candidate->proxy, at);
    knurl_shape_rest(&o->surface->shape, &hit, at, &touched->state, contact);
    knurl_pose_vector_to_own(o->before, candidate->normal, contact->normal);
    knurl_pose_to_own(o->pose, m->hip, hip);
    vec3_sub(hip, contact->proxy, at);
    contact->z = vec3_dot(at, contact->normal);
    contact->unsure = 0;
    contact->facet = NULL;
    touched->parts.count = 0;
    touched->state.inside = candidate->contact.inside && contact->z <= KNURL_ON_SURFACE;
    touched->held = contact->z <= reach && (touched->state.inside || contact->z >= 0.0);
}

/* Out of visits, and the HIP was in contact: a surface that is alone keeps its own contact, others repeat the last
 * tick's. No contact begins. */
static void keep_contacts(knurl_joint_search *m) {
    knurl_joint_set_free(m);
    if (knurl_joint_goes_on_alone(m)) {
        knurl_joint_set_proxy(m, 0);
        return;
    }
    for (uint32_t i = 0; i < m->near.count; i++) {
        const knurl_obstacle *o = &m->near.list[i];
        keep_contact(m, o, &m->touched[i]);
        if (knurl_joint_is_inside(&m->touched[i]) && m->pressed++ == 0) {
            knurl_pose_to_own(o->before, m->contacts->proxy.at, m->proxy);
            knurl_pose_to_parent(o->pose, m->proxy, m->proxy);
            vec3_copy(m->contacts->proxy.normal, m->normal);
        }
    }
}

/* Out of visits, and the HIP was free: tests each shape alone, with half of max_visits more for all of them. A shape
 * that needs more is queried again in the next tick, over the whole path since. */
static void begin_alone(knurl_joint_search *m) {
    knurl_contacts *c = m->contacts;
    const uint32_t share = c->budget.max / 2 / (m->near.count > 0 ? m->near.count : 1);
    double deepest = 1.0;
    uint32_t pressed = 0;
    knurl_joint_set_free(m);
    for (uint32_t i = 0; i < m->near.count; i++) {
        knurl_touched *touched = &m->touched[i];
        if (i >= m->queried || !knurl_joint_is_inside(touched)) {
            c->cache.of = NULL;
            c->budget.visits.left = knurl_visits_of(share).left;
            knurl_joint_query_contact(m, &m->near.list[i], touched);
        }
        if (c->budget.visits.left == 0 && !knurl_joint_is_inside(touched)) {
            keep_contact(m, &m->near.list[i], touched);
            m->late |= (uint64_t)!touched->held << i;
        }
        if (knurl_joint_is_inside(touched)) {
            pressed++;
            if (touched->contact.z < deepest) {
                deepest = touched->contact.z;
                knurl_joint_set_proxy(m, i);
            }
        }
    }
    m->pressed = pressed;
}

/* Begins, keeps or ends the contacts of the obstacles whose bits are set in `which`. */
static void update_contacts(knurl_joint_search *m, uint64_t which, uint32_t *flags) {
    for (uint32_t i = 0; i < m->near.count; i++) {
        knurl_obstacle *o = &m->near.list[i];
        knurl_candidate *candidate = o->candidate;
        if (!(which >> i & 1)) {
            continue;
        }
        if (!m->touched[i].held) {
            knurl_candidate_end_contact(candidate);
        } else if (!knurl_contacts_add(m->contacts, candidate, o->surface, o->record, o->pose, &m->touched[i])) {
            *flags |= KNURL_TICK_CONTACTS_FULL;
        }
        candidate->is_late = (m->late >> i & 1) != 0 && candidate->has_previous;
        candidate->has_previous = 1;
        candidate->jumps = o->record->motion.jumps;
        if (!candidate->is_late) {
            knurl_pose_to_own(o->pose, m->hip, candidate->previous);
        }
    }
}

/* If more contacts are found than fit: those that hold the HIP come before crests, and crests of the last tick before
 * new ones. held: bits of the last tick's contacts. */
static void make_room(knurl_joint_search *m, uint64_t held, uint32_t *flags) {
    uint32_t room = KNURL_CONTACTS_MAX;
    for (uint32_t i = 0; i < m->near.count; i++) {
        room -= room > 0 && knurl_joint_is_inside(&m->touched[i]);
    }
    for (uint64_t is_new = 0; is_new < 2; is_new++) {
        for (uint32_t i = 0; i < m->near.count; i++) {
            knurl_touched *touched = &m->touched[i];
            if ((held >> i & 1) == is_new || !touched->held || touched->state.inside) {
                continue;
            }
            touched->held = room > 0;
            *flags |= room > 0 ? 0 : KNURL_TICK_CONTACTS_FULL;
            room -= room > 0;
        }
    }
}

/* Finds this tick's contacts and proxy. Sets `unknown` if the visits ran out before. */
static void search(knurl_joint_search *m, uint32_t *flags) {
    const knurl_contacts *c = m->contacts;
    const int may_be_alone = c->proxy.holders <= 1 && !knurl_contacts_have_slipped(c);
    if (may_be_alone) {
        knurl_joint_collect(m, m->path, m->path->is_first ? KNURL_CAPTURE_DEPTH : m->margin);
    } else {
        knurl_joint_collect_all(m);
    }
    if (!c->has_previous || m->jumped) {
        find_first(m);
    } else if (!may_be_alone) {
        knurl_joint_search_faces(m, flags);
    } else if (!(c->proxy.holders ? continue_contact(m) : begin_contact(m))) {
        knurl_joint_collect_all(m);
        knurl_joint_search_faces(m, flags);
    }
}

/* Makes the results the HIP's contacts, at most KNURL_CONTACTS_MAX. */
static void commit(knurl_joint_search *m, uint32_t *flags) {
    knurl_contacts *c = m->contacts;
    uint64_t held = 0;
    c->now.count = 0;
    for (uint32_t i = 0; i < m->near.count; i++) {
        held |= (uint64_t)(m->near.list[i].candidate->in_contact != 0) << i;
    }
    make_room(m, held, flags);
    update_contacts(m, held, flags); /* first, so that they keep their places */
    if (m->near.count > 1 || held == 0) {
        update_contacts(m, ~held, flags);
    }
    vec3_copy(m->proxy, c->proxy.at);
    vec3_copy(m->normal, c->proxy.normal);
    c->proxy.holders = m->pressed;
    c->proxy.whole = m->whole;
    c->slip.time = m->pressed ? -1.0 : c->slip.time;
}

void knurl_joint_contact(knurl_contacts *c, const knurl_broad_index *index, const knurl_hip_path *path,
                         uint32_t *flags) {
    knurl_joint_search m;
    m.contacts = c;
    m.index = index;
    m.path = path;
    m.near.visits = &c->budget.visits;
    m.unknown = 0;
    m.queried = 0;
    m.late = 0;
    m.whole = 0.0;
    m.hip = path->to;
    m.margin = knurl_hip_path_margin(path);
    vec3_copy(c->proxy.normal, m.normal);
    search(&m, flags);
    if (m.unknown && c->proxy.holders) {
        keep_contacts(&m);
    } else if (m.unknown) {
        begin_alone(&m);
    }
    commit(&m, flags);
}

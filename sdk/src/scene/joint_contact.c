/* Contact with several surfaces. Read knurl_joint_contact(), at the end, first. While one surface alone holds the HIP
 * and nothing is in the proxy's way, that surface's own contact is used; otherwise a god-object finds the faces that
 * hold the proxy together.
 * SPDX-License-Identifier: MIT */
#include "scene/joint_contact.h"

#include "scene/god_object.h"

#include <string.h>

/* m: rounding of a path's ends, with seams. */
#define ROUNDING 1e-6

/* What is being found in one tick. */
typedef struct meeting {
    knurl_contacts *contacts;
    const knurl_broad_index *index;
    const knurl_hip_path *path;
    const double *hip; /* scene: the path's end */
    knurl_obstacles near;
    knurl_touched touched[KNURL_CANDIDATES_MAX];
    int jumped;      /* one that held the HIP has jumped */
    int unknown;     /* 1: the visits were used up before it was found what holds the HIP */
    double room;     /* m: how far a proxy may go in the tick, at most, among what was collected */
    double proxy[3]; /* what comes out, beside `touched` */
    double normal[3];
    uint32_t pressed;
} meeting;

/* m: how far a path's proxy is from its ends, at most. */
static double proxy_distance(const knurl_hip_path *path) {
    return sqrt(knurl_max(vec3_distance2(path->proxy, path->from), vec3_distance2(path->proxy, path->to)));
}

/* What comes within `room` (m) of a path, and what was in contact. */
static void collect(meeting *m, const knurl_hip_path *path, double room) {
    knurl_contacts *c = m->contacts;
    const double round = room + proxy_distance(path);
    m->near.count = 0;
    m->near.moving = m->jumped = 0;
    for (uint32_t i = 0; i < c->candidates.count; i++) {
        knurl_candidate *candidate = &c->candidates.list[i];
        knurl_obstacle *o = &m->near.list[m->near.count];
        const knurl_surface_data *surface = NULL;
        if (candidate->in_contact || knurl_candidate_is_near(candidate, path, room)) {
            surface = knurl_contacts_surface(m->index, candidate);
        }
        if (surface) {
            const knurl_record *record = __atomic_load_n(&surface->record, __ATOMIC_SEQ_CST);
            knurl_contacts_catch_up(c, &record->motion);
            knurl_obstacle_set(o, candidate, surface, record, &c->clock);
        }
        if (!surface || !(candidate->in_contact || knurl_obstacle_is_near(o, path->from, path->to, round))) {
            candidate->has_previous = 0;
            continue;
        }
        m->near.count++;
        m->near.moving |= o->before != o->pose;
        m->jumped |= candidate->in_contact && knurl_obstacle_has_jumped(o);
    }
}

/* What one shape says by itself to a HIP at `hip` that came from `previous` (scene); or null: from nowhere. */
static void ask(const meeting *m, const knurl_obstacle *o, const double hip[3], const double *previous,
                knurl_touched *touched) {
    knurl_contact_query query;
    query.has_previous = previous != NULL;
    query.reach = o->record->reach;
    query.double_sided = o->surface->double_sided;
    query.facet = &o->candidate->facet;
    query.visits = &m->contacts->visits;
    knurl_pose_to_own(o->pose, hip, query.hip);
    vec3_copy(query.hip, query.previous);
    if (previous && !touched->state.inside) { /* who is inside came from there */
        knurl_pose_to_own(o->before, previous, query.previous);
    }
    touched->held = knurl_shape_contact(&o->surface->shape, &query, &touched->state, &touched->contact);
}

/* As it comes: what is seen for the first time, or has jumped, may find the HIP inside. */
static void ask_plainly(meeting *m, const knurl_obstacle *o, knurl_touched *touched) {
    const knurl_contacts *c = m->contacts;
    const int jumped = knurl_obstacle_has_jumped(o);
    const int anew = !c->has_previous || (jumped && o->candidate->in_contact);
    touched->state = o->candidate->contact;
    if (anew) {
        memset(&touched->state, 0, sizeof touched->state);
    }
    ask(m, o, m->hip, anew ? NULL : c->previous, touched);
}

/* What has jumped while it held the HIP. Where both its sides can be touched, it holds the one that it held. */
static void ask_jumped(const meeting *m, const knurl_obstacle *o, knurl_touched *touched) {
    if (!touched->held && o->candidate->in_contact && o->surface->double_sided) {
        double from[3];
        vec3_madd(o->candidate->proxy, KNURL_CAPTURE_DEPTH, o->candidate->normal, from);
        memset(&touched->state, 0, sizeof touched->state);
        ask(m, o, m->hip, from, touched);
    }
}

/* Whether the crests of a surface that does not hold the proxy reach it; those of one that lies in a face that holds it
 * are that face's. */
static void ask_reach(meeting *m, const knurl_obstacle *o, knurl_touched *touched) {
    touched->held = 0;
    touched->state = o->candidate->contact;
    if (touched->state.inside) {
        memset(&touched->state, 0, sizeof touched->state);
    }
    if (m->pressed == 0 || o->record->reach > KNURL_ON_SURFACE) {
        ask(m, o, m->proxy, m->proxy, touched);
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

static int is_inside(const knurl_touched *touched) {
    return touched->held && touched->state.inside;
}

/* The proxy that one shape found: where it rests, and which way it is held. */
static void set_proxy(meeting *m, uint32_t i) {
    const knurl_obstacle *o = &m->near.list[i];
    const knurl_contact *contact = &m->touched[i].contact;
    knurl_pose_to_parent(o->pose, contact->proxy, m->proxy);
    knurl_pose_vector_to_parent(o->pose, contact->normal, m->normal);
    vec3_madd(m->proxy, o->surface->shape.seam, m->normal, m->proxy);
    m->pressed = 1;
}

static void set_free(meeting *m) {
    vec3_copy(m->hip, m->proxy);
    m->pressed = 0;
}

/* 1 where all that is in the proxy's way has been collected. */
static int is_in_room(const meeting *m, const double from[3]) {
    return m->pressed == 0 || vec3_distance2(from, m->proxy) <= m->room * m->room;
}

/* A HIP that nothing held: each shape by itself, where one at most begins to, and its proxy's way is free. */
static int begin(meeting *m) {
    uint32_t holder = KNURL_NO_OBSTACLE;
    set_free(m);
    for (uint32_t i = 0; i < m->near.count; i++) {
        ask_plainly(m, &m->near.list[i], &m->touched[i]);
        if (m->touched[i].contact.unsure || (is_inside(&m->touched[i]) && holder != KNURL_NO_OBSTACLE) ||
            knurl_obstacles_are_unknown(&m->near)) {
            return 0;
        }
        holder = is_inside(&m->touched[i]) ? i : holder;
    }
    if (holder == KNURL_NO_OBSTACLE) {
        return 1;
    }
    set_proxy(m, holder);
    return is_in_room(m, m->contacts->previous) &&
           knurl_god_object_can_go(&m->near, m->contacts->previous, m->normal, m->proxy, m->normal, holder);
}

/* The only one that held the HIP, or KNURL_NO_OBSTACLE. */
static uint32_t find_holder(const meeting *m) {
    uint32_t holder = KNURL_NO_OBSTACLE;
    for (uint32_t i = 0; i < m->near.count && m->contacts->pressed == 1; i++) {
        holder = m->near.list[i].candidate->contact.inside ? i : holder;
    }
    return holder;
}

/* A HIP that one surface held: that shape by itself, where its proxy's way runs into no other. */
static int carry_on(meeting *m) {
    const knurl_contacts *c = m->contacts;
    const uint32_t holder = find_holder(m);
    if (holder == KNURL_NO_OBSTACLE) {
        return 0;
    }
    knurl_touched *touched = &m->touched[holder];
    ask_plainly(m, &m->near.list[holder], touched);
    const int unsure = touched->contact.unsure;
    if ((!touched->held && unsure) || knurl_obstacles_are_unknown(&m->near)) {
        return 0;
    }
    set_free(m);
    if (is_inside(touched)) {
        set_proxy(m, holder);
    }
    if (!is_in_room(m, c->proxy) ||
        !knurl_god_object_can_go(&m->near, c->proxy, c->normal, m->proxy, m->pressed ? m->normal : c->normal,
                                 unsure ? KNURL_NO_OBSTACLE : holder)) {
        return 0;
    }
    for (uint32_t i = 0; i < m->near.count; i++) {
        if (i != holder) {
            ask_reach(m, &m->near.list[i], &m->touched[i]);
        }
    }
    return 1;
}

/* The faces of one obstacle that press, as one contact; longest: m, that a face may press. */
static void share(const meeting *m, const knurl_active_faces *faces, uint32_t obstacle, double longest,
                  knurl_touched *touched) {
    const knurl_obstacle *o = &m->near.list[obstacle];
    const knurl_active_face *most = NULL;
    double sum[3] = {0.0, 0.0, 0.0};
    double own[3];
    for (uint32_t i = 0; i < faces->count; i++) {
        const knurl_active_face *face = &faces->list[i];
        if (face->obstacle == obstacle && face->press > 0.0) {
            vec3_madd(sum, face->press, face->normal, sum);
            most = !most || face->press > most->press ? face : most;
        }
    }
    touched->held = most != NULL;
    if (!most) {
        return;
    }
    const double depth = vec3_normalise(sum);
    knurl_pose_to_own(o->pose, m->proxy, own);
    knurl_shape_rest(&o->surface->shape, &most->hit, own, &touched->state, &touched->contact);
    knurl_pose_vector_to_own(o->pose, sum, touched->contact.normal);
    touched->contact.z = depth < longest ? -depth : -longest;
    touched->contact.unsure = 0;
    touched->contact.facet = NULL;
}

/* What the god-object has come to, as contacts. */
static void share_out(meeting *m, knurl_god_object *g) {
    double held[3];
    for (uint32_t i = 0; i < g->faces.count; i++) { /* on the faces, not above them */
        g->faces.list[i].offset -= g->faces.list[i].rest;
    }
    vec3_copy(g->at, m->proxy);
    if (g->faces.count > 0 && knurl_active_faces_project(&g->faces, m->hip, held) &&
        vec3_distance2(held, g->at) < ROUNDING * ROUNDING) { /* else it is still on its way */
        vec3_copy(held, m->proxy);
    }
    vec3_sub(m->proxy, m->hip, m->normal);
    const double longest = vec3_normalise(m->normal);
    for (uint32_t i = 0; i < m->near.count; i++) {
        share(m, &g->faces, i, longest, &m->touched[i]);
        m->pressed += (uint32_t)m->touched[i].held;
    }
    vec3_copy(g->at, m->proxy);
    if (g->faces.count > 0 && m->pressed == 0) { /* it touches, and is not pressed yet */
        m->pressed = 2;
    }
}

/* The HIP has just come off a rim: looks for a surface that goes on there, a little higher up or beyond a crack, over
 * where the HIP is now. */
static void find_next(meeting *m, knurl_god_object *g) {
    const knurl_slip *slip = &m->contacts->slip;
    double up[3];
    double above[3];
    vec3_sub(slip->proxy, m->hip, above);
    const double depth = vec3_dot(above, slip->normal);
    if (!(depth > 0.0)) {
        return;
    }
    vec3_madd(slip->proxy, KNURL_STEP_HEIGHT, slip->normal, up);
    vec3_madd(m->hip, depth + KNURL_STEP_HEIGHT, slip->normal, above);
    knurl_hip_path path = *m->path;
    path.proxy = above;
    knurl_hip_path_bound(&path);
    collect(m, &path, sqrt(vec3_distance2(above, m->hip)));
    const knurl_segment rise = {slip->proxy, up, 0, KNURL_NO_OBSTACLE};
    const knurl_segment across = {up, above, 0, KNURL_NO_OBSTACLE};
    if (knurl_obstacles_are_clear(&m->near, &rise) && knurl_obstacles_are_clear(&m->near, &across)) {
        (void)knurl_god_object_step_down(g, &m->near, above, slip->normal, m->hip);
    }
}

/* A HIP that was held is held no longer, and is not out in front of where it was held. */
static void slip_off(knurl_contacts *c, const double hip[3]) {
    double way[3];
    vec3_sub(hip, c->proxy, way);
    if (vec3_dot(way, c->normal) < -ROUNDING) {
        c->slip.time = c->clock.time;
        c->slip.ramped_depth = c->ramped_depth;
        vec3_copy(c->proxy, c->slip.proxy);
        vec3_copy(c->normal, c->slip.normal);
    }
}

/* 1 where a surface that held the HIP is still there. One that was taken out has no rim to come off. */
static int has_holder(const meeting *m) {
    int has = 0;
    for (uint32_t i = 0; i < m->near.count; i++) {
        has |= m->near.list[i].candidate->contact.inside;
    }
    return has;
}

/* All faces near, at once. */
static void settle(meeting *m, uint32_t *flags) {
    knurl_contacts *c = m->contacts;
    knurl_god_object g;
    memset(&g, 0, sizeof g);
    m->pressed = 0;
    vec3_copy(c->pressed ? c->proxy : c->previous, g.at);
    collect(m, m->path, ROUNDING + proxy_distance(m->path)); /* no farther from the HIP than it is now */
    knurl_god_object_push(&g, &m->near);
    knurl_god_object_follow(&g, &m->near, m->hip);
    m->unknown = g.faces.count == 0 && knurl_obstacles_are_unknown(&m->near);
    if (m->unknown) {
        return;
    }
    if (g.faces.count == 0 && c->pressed && has_holder(m)) {
        slip_off(c, m->hip);
    }
    if (g.faces.count == 0 && knurl_contacts_have_slipped(c)) {
        find_next(m, &g);
    }
    share_out(m, &g);
    for (uint32_t i = 0; i < m->near.count; i++) {
        if (!m->touched[i].held) {
            ask_reach(m, &m->near.list[i], &m->touched[i]);
        }
    }
    if (g.squeezed) {
        *flags |= KNURL_TICK_SQUEEZED;
    }
}

/* Each shape by itself: nothing is known of where the HIP was. Where the HIP is in front of another face, between it
 * and the one that would hold it, it is outside of both. */
static void find_first(meeting *m) {
    double deepest = 1.0;
    double proxy[3] = {0.0, 0.0, 0.0}, normal[3] = {0.0, 0.0, 0.0};
    uint32_t pressed = 0;
    for (uint32_t i = 0; i < m->near.count; i++) {
        knurl_touched *touched = &m->touched[i];
        ask_plainly(m, &m->near.list[i], touched);
        if (knurl_obstacle_has_jumped(&m->near.list[i])) { /* a contact that begins anew */
            ask_jumped(m, &m->near.list[i], touched);
            knurl_contacts_end(m->near.list[i].candidate);
        }
        if (!is_inside(touched)) {
            continue;
        }
        set_proxy(m, i);
        const knurl_segment way = {m->hip, m->proxy, 0, i};
        touched->held = knurl_obstacles_are_clear(&m->near, &way);
        pressed += (uint32_t)touched->held;
        if (touched->held && touched->contact.z < deepest) {
            deepest = touched->contact.z;
            vec3_copy(m->proxy, proxy);
            vec3_copy(m->normal, normal);
        }
    }
    set_free(m);
    if (pressed > 0) {
        vec3_copy(proxy, m->proxy);
        vec3_copy(normal, m->normal);
        m->pressed = pressed;
    }
}

/* A contact as it was a tick ago, its proxy and normal carried along by the surface. */
static void hold_still(const meeting *m, const knurl_obstacle *o, knurl_touched *touched) {
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
    touched->state.inside = candidate->contact.inside && contact->z <= KNURL_ON_SURFACE;
    touched->held = contact->z <= reach && (touched->state.inside || contact->z >= 0.0);
}

/* It is not known what holds a HIP that was held: what held it holds it where it did, and no contact begins. */
static void hold_all_still(meeting *m) {
    set_free(m);
    for (uint32_t i = 0; i < m->near.count; i++) {
        const knurl_obstacle *o = &m->near.list[i];
        hold_still(m, o, &m->touched[i]);
        if (is_inside(&m->touched[i]) && m->pressed++ == 0) {
            knurl_pose_to_own(o->before, m->contacts->proxy, m->proxy);
            knurl_pose_to_parent(o->pose, m->proxy, m->proxy);
            vec3_copy(m->contacts->normal, m->normal);
        }
    }
}

/* It is not known what holds a HIP that nothing held: each shape by itself, with a few visits more. */
static void begin_alone(meeting *m) {
    knurl_contacts *c = m->contacts;
    const uint32_t share = 1 + c->max_visits / 4 / (m->near.count + 1);
    double deepest = 1.0;
    uint32_t pressed = 0;
    set_free(m);
    for (uint32_t i = 0; i < m->near.count; i++) {
        knurl_touched *touched = &m->touched[i];
        c->visits.left = share;
        ask_plainly(m, &m->near.list[i], touched);
        if (c->visits.left == 0) {
            hold_still(m, &m->near.list[i], touched);
        }
        if (is_inside(touched)) {
            pressed++;
            if (touched->contact.z < deepest) {
                deepest = touched->contact.z;
                set_proxy(m, i);
            }
        }
    }
    m->pressed = pressed;
}

/* From what the shapes said to contacts; held: bits of those that were in contact, who keep their places. */
static void take(meeting *m, uint64_t held, uint32_t *flags) {
    for (uint32_t i = 0; i < m->near.count; i++) {
        knurl_obstacle *o = &m->near.list[i];
        knurl_candidate *candidate = o->candidate;
        if (!(held >> i & 1)) {
            continue;
        }
        if (!m->touched[i].held) {
            knurl_contacts_end(candidate);
        } else if (!knurl_contacts_add(m->contacts, candidate, o->surface, o->record, o->pose, &m->touched[i])) {
            *flags |= KNURL_TICK_CONTACTS_FULL;
        }
        candidate->has_previous = 1;
        candidate->jumps = o->record->motion.jumps;
        knurl_pose_to_own(o->pose, m->hip, candidate->previous);
    }
}

void knurl_joint_contact(knurl_contacts *c, const knurl_broad_index *index, const knurl_hip_path *path,
                         uint32_t *flags) {
    meeting m;
    uint64_t held = 0;
    m.contacts = c;
    m.index = index;
    m.path = path;
    m.near.visits = &c->visits;
    m.unknown = 0;
    m.hip = path->to;
    m.room = knurl_hip_path_room(path);
    collect(&m, path, path->is_first ? KNURL_CAPTURE_DEPTH : m.room);
    vec3_copy(c->normal, m.normal);
    if (!c->has_previous || m.jumped) {
        find_first(&m);
    } else if (knurl_contacts_have_slipped(c) || !(c->pressed ? carry_on(&m) : begin(&m))) {
        settle(&m, flags);
    }
    if (m.unknown && c->pressed) {
        hold_all_still(&m);
    } else if (m.unknown) {
        begin_alone(&m);
    }
    c->active_count = 0;
    for (uint32_t i = 0; i < m.near.count; i++) {
        held |= (uint64_t)(m.near.list[i].candidate->in_contact != 0) << i;
    }
    take(&m, held, flags);
    if (m.near.count > 1 || held == 0) {
        take(&m, ~held, flags);
    }
    vec3_copy(m.proxy, c->proxy);
    vec3_copy(m.normal, c->normal);
    c->pressed = m.pressed;
    c->slip.time = c->pressed ? -1.0 : c->slip.time;
}

/* Contact with several surfaces. Read knurl_joint_contact(), at the end, first. While one surface alone holds the HIP
 * and nothing is in the proxy's way, that surface's own contact is used; otherwise a god-object finds the faces that
 * hold the proxy together.
 * SPDX-License-Identifier: MIT */
#include "scene/joint_contact.h"

#include "scene/god_object.h"

#include <string.h>

/* m: rounding of a path's ends, with seams. */
#define ROUNDING 1e-6

/* The working data of one tick's search. */
typedef struct joint_search {
    knurl_contacts *contacts;
    const knurl_broad_index *index;
    const knurl_hip_path *path;
    const double *hip; /* scene: the path's end */
    knurl_obstacles near;
    knurl_touched touched[KNURL_CANDIDATES_MAX];
    int jumped;      /* 1: a surface in contact has jumped */
    uint32_t asked;  /* so many of the first obstacles were asked for their contact with the HIP: `touched` */
    uint64_t late;   /* bits of obstacles whose search was cut short, so that the HIP may have crossed them */
    int unknown;     /* 1: the visits were used up before the contacts were found */
    double margin;   /* m: obstacles were collected this far around the path; a proxy may move no farther */
    double proxy[3]; /* results, with `touched`: */
    double normal[3];
    uint32_t pressed;
} joint_search;

/* m: how far a path's proxy is from its ends, at most. */
static double proxy_distance(const knurl_hip_path *path) {
    return sqrt(knurl_max(vec3_distance2(path->proxy, path->from), vec3_distance2(path->proxy, path->to)));
}

/* One more obstacle. Where another was in its place at the last collection, what is in `touched` is not its own. */
static void add_obstacle(joint_search *m, const knurl_obstacle *obstacle) {
    const uint32_t i = m->near.count++;
    m->asked = i < m->asked && m->near.list[i].candidate != obstacle->candidate ? i : m->asked;
    m->near.list[i] = *obstacle;
    m->near.moving |= obstacle->before != obstacle->pose;
    m->jumped |= obstacle->candidate->in_contact && knurl_obstacle_has_jumped(obstacle);
}

/* Collects the obstacles within `margin` (m) of a path, and those in contact. */
static void collect(joint_search *m, const knurl_hip_path *path, double margin) {
    knurl_contacts *c = m->contacts;
    const double reach = margin + proxy_distance(path);
    m->near.count = 0;
    m->near.moving = m->jumped = 0;
    for (uint32_t i = 0; i < c->candidates.count; i++) {
        knurl_candidate *candidate = knurl_candidates_at(&c->candidates, i);
        const knurl_surface_data *surface = NULL;
        knurl_obstacle o;
        if (candidate->in_contact || knurl_candidate_is_near(candidate, path, margin)) {
            surface = knurl_contacts_surface(m->index, candidate);
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
    m->asked = m->asked < m->near.count ? m->asked : m->near.count;
}

/* One shape's contact with a HIP at `hip`, as if it were alone. previous: the HIP a tick ago (scene); null: unknown. */
static void query_shape(const joint_search *m, const knurl_obstacle *o, const double hip[3], const double *previous,
                        knurl_touched *touched) {
    knurl_contact_query query;
    query.has_previous = previous != NULL;
    query.reach = o->record->reach;
    query.double_sided = o->surface->double_sided;
    query.facet = &o->candidate->facet;
    query.part = &o->candidate->part;
    query.visits = &m->contacts->visits;
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

/* The same for this tick's HIP. On a first tick, and where the surface in contact has jumped, the HIP may be inside. */
static void query_contact(joint_search *m, const knurl_obstacle *o, knurl_touched *touched) {
    const knurl_contacts *c = m->contacts;
    const int jumped = knurl_obstacle_has_jumped(o);
    const int anew = !c->has_previous || (jumped && o->candidate->in_contact);
    if (o->candidate == c->asked_of && !anew) {
        *touched = c->asked;
        return;
    }
    touched->state = o->candidate->contact;
    if (anew) {
        memset(&touched->state, 0, sizeof touched->state);
    }
    query_shape(m, o, m->hip, anew ? NULL : c->previous, touched);
}

/* A surface in contact has jumped. A double-sided one keeps the HIP on the side where it was. */
static void query_jumped(const joint_search *m, const knurl_obstacle *o, knurl_touched *touched) {
    if (!touched->held && o->candidate->in_contact && o->surface->double_sided) {
        double from[3];
        vec3_madd(o->candidate->proxy, KNURL_CAPTURE_DEPTH, o->candidate->normal, from);
        memset(&touched->state, 0, sizeof touched->state);
        query_shape(m, o, m->hip, from, touched);
    }
}

/* Contact with the crests of a surface that the proxy is outside of. A surface that lies in a pressed face is left out:
 * that face's crests are felt. */
static void query_crests(joint_search *m, const knurl_obstacle *o, knurl_touched *touched) {
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

static int is_inside(const knurl_touched *touched) {
    return touched->held && touched->state.inside;
}

/* Takes the proxy and the normal from one shape's contact. */
static void set_proxy(joint_search *m, uint32_t i) {
    const knurl_obstacle *o = &m->near.list[i];
    const knurl_contact *contact = &m->touched[i].contact;
    knurl_pose_to_parent(o->pose, contact->proxy, m->proxy);
    knurl_pose_vector_to_parent(o->pose, contact->normal, m->normal);
    vec3_madd(m->proxy, o->surface->shape.seam, m->normal, m->proxy);
    m->pressed = 1;
}

static void set_free(joint_search *m) {
    vec3_copy(m->hip, m->proxy);
    m->pressed = 0;
}

/* 1 where everything between `from` and the proxy has been collected. */
static int is_collected(const joint_search *m, const double from[3]) {
    return m->pressed == 0 || vec3_distance2(from, m->proxy) <= m->margin * m->margin;
}

/* A HIP that was free. Returns 1 where one shape at most begins contact and the path to its proxy is clear. */
static int begin_contact(joint_search *m) {
    uint32_t holder = KNURL_NO_OBSTACLE;
    set_free(m);
    for (uint32_t i = 0; i < m->near.count; i++) {
        query_contact(m, &m->near.list[i], &m->touched[i]);
        m->asked = i + 1;
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
    return is_collected(m, m->contacts->previous) &&
           knurl_god_object_can_go(&m->near, m->contacts->previous, m->normal, m->proxy, m->normal, holder);
}

/* The only surface that held the HIP in the last tick, or KNURL_NO_OBSTACLE. */
static uint32_t find_holder(const joint_search *m) {
    uint32_t holder = KNURL_NO_OBSTACLE;
    for (uint32_t i = 0; i < m->near.count && m->contacts->pressed == 1; i++) {
        holder = m->near.list[i].candidate->contact.inside ? i : holder;
    }
    return holder;
}

/* A HIP that one surface held. Returns 1 where the proxy's path on it hits no other surface. */
static int continue_contact(joint_search *m) {
    const knurl_contacts *c = m->contacts;
    const uint32_t holder = find_holder(m);
    if (holder == KNURL_NO_OBSTACLE) {
        return 0;
    }
    knurl_touched *touched = &m->touched[holder];
    query_contact(m, &m->near.list[holder], touched);
    m->asked = m->near.count == 1;
    const int unsure = touched->contact.unsure;
    if ((!touched->held && unsure) || knurl_obstacles_are_unknown(&m->near)) {
        return 0;
    }
    set_free(m);
    if (is_inside(touched)) {
        set_proxy(m, holder);
    }
    if (!is_collected(m, c->proxy) ||
        !knurl_god_object_can_go(&m->near, c->proxy, c->normal, m->proxy, m->pressed ? m->normal : c->normal,
                                 unsure ? KNURL_NO_OBSTACLE : holder)) {
        return 0;
    }
    for (uint32_t i = 0; i < m->near.count; i++) {
        if (i != holder) {
            query_crests(m, &m->near.list[i], &m->touched[i]);
        }
    }
    return 1;
}

/* Adds up the pressed faces of one obstacle to one contact. longest: m, its greatest depth. */
static void sum_faces(const joint_search *m, const knurl_active_faces *faces, uint32_t obstacle, double longest,
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

/* Turns the god-object's faces into contacts. */
static void use_god_object(joint_search *m, knurl_god_object *g) {
    double held[3];
    for (uint32_t i = 0; i < g->faces.count; i++) { /* on the faces, not above them */
        g->faces.list[i].offset -= g->faces.list[i].rest;
    }
    vec3_copy(g->at, m->proxy);
    if (g->faces.count > 0 && knurl_active_faces_project(&g->faces, m->hip, held) &&
        vec3_distance2(held, g->at) < ROUNDING * ROUNDING) { /* else it has not arrived yet */
        vec3_copy(held, m->proxy);
    }
    vec3_sub(m->proxy, m->hip, m->normal);
    const double longest = vec3_normalise(m->normal);
    for (uint32_t i = 0; i < m->near.count; i++) {
        sum_faces(m, &g->faces, i, longest, &m->touched[i]);
        m->pressed += (uint32_t)m->touched[i].held;
    }
    vec3_copy(g->at, m->proxy);
    if (g->faces.count > 0 && m->pressed == 0) { /* touching, without depth */
        m->pressed = 2;
    }
}

/* The HIP has just slipped off a rim: looks above it for a surface that continues there, beyond a small step or crack.
 */
static void find_next(joint_search *m, knurl_god_object *g) {
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

/* Remembers where contact ended without the HIP moving out in front of the surface: it slipped off a rim. */
static void note_slip(knurl_contacts *c, const double hip[3]) {
    double way[3];
    vec3_sub(hip, c->proxy, way);
    if (vec3_dot(way, c->normal) < -ROUNDING) {
        c->slip.time = c->clock.time;
        c->slip.ramped_depth = c->ramped_depth;
        vec3_copy(c->proxy, c->slip.proxy);
        vec3_copy(c->normal, c->slip.normal);
    }
}

/* 1 where a surface that held the HIP is still in the scene; a HIP cannot slip off a removed one. */
static int has_holder(const joint_search *m) {
    int has = 0;
    for (uint32_t i = 0; i < m->near.count; i++) {
        has |= m->near.list[i].candidate->contact.inside;
    }
    return has;
}

/* 1 where parts of the mesh go through or touch each other: then a god-object's face counts for more. */
static int has_parts(const knurl_touched *touched) {
    return (touched->contact.unsure & KNURL_UNSURE_PARTS) != 0;
}

/* 1 where the surface that holds the HIP is the only one near, and its own contact is known. */
static int goes_on_alone(const joint_search *m) {
    return m->contacts->pressed == 1 && m->near.count == 1 && m->asked == 1 && is_inside(&m->touched[0]);
}

/* m: how far a proxy goes in a tick after one whose visits were used up; half as far after two, and so on. Short ways
 * are cheap, so that it catches up. */
#define SHORT_WAY 0.0005

/* Moves the god-object as near to the HIP as can be. */
static void follow(const joint_search *m, knurl_god_object *g) {
    double way[3];
    vec3_sub(m->hip, g->at, way);
    const double length = vec3_length(way);
    const double longest = ldexp(2.0 * SHORT_WAY, -(int)m->contacts->cut_short);
    if (m->contacts->cut_short > 0 && length > longest) {
        double target[3];
        vec3_madd(g->at, longest / length, way, target);
        knurl_god_object_follow(g, &m->near, target);
        if (g->faces.count > 0) {
            return;
        }
    }
    knurl_god_object_follow(g, &m->near, m->hip);
}

/* Collects the obstacles that a god-object may meet: it only comes nearer to the HIP. */
static void collect_for_god_object(joint_search *m) {
    collect(m, m->path, ROUNDING + proxy_distance(m->path));
}

/* Finds contact with all faces nearby at once, by a god-object. The obstacles have been collected for it. */
static void search_all_faces(joint_search *m, uint32_t *flags) {
    knurl_contacts *c = m->contacts;
    knurl_god_object g;
    memset(&g, 0, sizeof g);
    m->pressed = 0;
    vec3_copy(c->pressed ? c->proxy : c->previous, g.at);
    knurl_god_object_push(&g, &m->near);
    follow(m, &g);
    m->unknown = knurl_obstacles_are_unknown(&m->near) &&
                 (g.faces.count == 0 || (goes_on_alone(m) && !has_parts(&m->touched[0])));
    if (m->unknown) {
        return;
    }
    if (g.faces.count == 0 && c->pressed && has_holder(m)) {
        note_slip(c, m->hip);
    }
    if (g.faces.count == 0 && knurl_contacts_have_slipped(c)) {
        find_next(m, &g);
    }
    use_god_object(m, &g);
    for (uint32_t i = 0; i < m->near.count; i++) {
        if (!m->touched[i].held) {
            query_crests(m, &m->near.list[i], &m->touched[i]);
        }
    }
    if (g.squeezed) {
        *flags |= KNURL_TICK_SQUEEZED;
    }
}

/* Where the HIP's last position is unknown, each shape is tested alone. One that another face separates from the HIP is
 * not in contact. */
static void find_first(joint_search *m) {
    double deepest = 1.0;
    double proxy[3] = {0.0, 0.0, 0.0}, normal[3] = {0.0, 0.0, 0.0};
    uint32_t pressed = 0;
    for (uint32_t i = 0; i < m->near.count; i++) {
        knurl_touched *touched = &m->touched[i];
        query_contact(m, &m->near.list[i], touched);
        if (knurl_obstacle_has_jumped(&m->near.list[i])) { /* its old contact ends */
            query_jumped(m, &m->near.list[i], touched);
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

/* Repeats the last tick's contact; its proxy and normal move with the surface. */
static void keep_contact(const joint_search *m, const knurl_obstacle *o, knurl_touched *touched) {
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

/* The visits are used up and the HIP was in contact: a surface that nothing else is near goes on alone, others repeat
 * the last tick's contact; none begins. */
static void keep_contacts(joint_search *m) {
    set_free(m);
    if (goes_on_alone(m)) {
        set_proxy(m, 0);
        return;
    }
    for (uint32_t i = 0; i < m->near.count; i++) {
        const knurl_obstacle *o = &m->near.list[i];
        keep_contact(m, o, &m->touched[i]);
        if (is_inside(&m->touched[i]) && m->pressed++ == 0) {
            knurl_pose_to_own(o->before, m->contacts->proxy, m->proxy);
            knurl_pose_to_parent(o->pose, m->proxy, m->proxy);
            vec3_copy(m->contacts->normal, m->normal);
        }
    }
}

/* The visits are used up and the HIP was free: tests each shape alone. Together they may use half of max_visits more.
 * One that this is not enough for is asked again in the next tick, about all of the way since. */
static void begin_alone(joint_search *m) {
    knurl_contacts *c = m->contacts;
    const uint32_t share = 1 + c->max_visits / 2 / (m->near.count > 0 ? m->near.count : 1);
    double deepest = 1.0;
    uint32_t pressed = 0;
    set_free(m);
    for (uint32_t i = 0; i < m->near.count; i++) {
        knurl_touched *touched = &m->touched[i];
        if (i >= m->asked || !is_inside(touched)) {
            c->asked_of = NULL;
            c->visits.left = share;
            query_contact(m, &m->near.list[i], touched);
        }
        if (c->visits.left == 0 && !is_inside(touched)) {
            keep_contact(m, &m->near.list[i], touched);
            m->late |= (uint64_t)!touched->held << i;
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

/* Begins, keeps or ends the contacts of the obstacles named by the bits of `which`. */
static void update_contacts(joint_search *m, uint64_t which, uint32_t *flags) {
    for (uint32_t i = 0; i < m->near.count; i++) {
        knurl_obstacle *o = &m->near.list[i];
        knurl_candidate *candidate = o->candidate;
        if (!(which >> i & 1)) {
            continue;
        }
        if (!m->touched[i].held) {
            knurl_contacts_end(candidate);
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

/* Where more contacts are found than there is room for, those that hold the HIP come before crests, and among these,
 * those of the last tick. held: the bits of the last tick's. */
static void make_room(joint_search *m, uint64_t held, uint32_t *flags) {
    uint32_t room = KNURL_CONTACTS_MAX;
    for (uint32_t i = 0; i < m->near.count; i++) {
        room -= room > 0 && is_inside(&m->touched[i]);
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

void knurl_joint_contact(knurl_contacts *c, const knurl_broad_index *index, const knurl_hip_path *path,
                         uint32_t *flags) {
    joint_search m;
    uint64_t held = 0;
    m.contacts = c;
    m.index = index;
    m.path = path;
    m.near.visits = &c->visits;
    m.unknown = 0;
    m.asked = 0;
    m.late = 0;
    m.hip = path->to;
    m.margin = knurl_hip_path_margin(path);
    const int may_be_alone = c->pressed <= 1 && !knurl_contacts_have_slipped(c);
    if (may_be_alone) {
        collect(&m, path, path->is_first ? KNURL_CAPTURE_DEPTH : m.margin);
    } else {
        collect_for_god_object(&m);
    }
    vec3_copy(c->normal, m.normal);
    if (!c->has_previous || m.jumped) {
        find_first(&m);
    } else if (!may_be_alone) {
        search_all_faces(&m, flags);
    } else if (!(c->pressed ? continue_contact(&m) : begin_contact(&m))) {
        collect_for_god_object(&m);
        search_all_faces(&m, flags);
    }
    if (m.unknown && c->pressed) {
        keep_contacts(&m);
    } else if (m.unknown) {
        begin_alone(&m);
    }
    c->active_count = 0;
    for (uint32_t i = 0; i < m.near.count; i++) {
        held |= (uint64_t)(m.near.list[i].candidate->in_contact != 0) << i;
    }
    make_room(&m, held, flags);
    update_contacts(&m, held, flags); /* first, so that they keep their places */
    if (m.near.count > 1 || held == 0) {
        update_contacts(&m, ~held, flags);
    }
    vec3_copy(m.proxy, c->proxy);
    vec3_copy(m.normal, c->normal);
    c->pressed = m.pressed;
    c->slip.time = c->pressed ? -1.0 : c->slip.time;
}

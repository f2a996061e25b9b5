/* Contact with all faces nearby at once, by a god-object. Read knurl_joint_search_faces(), at the end, first.
 * SPDX-License-Identifier: MIT */
#include "proxy/joint_faces.h"

#include "proxy/felt.h"
#include "proxy/god_object.h"

#include <string.h>

/* Adds up the pressed faces of one obstacle to one contact. longest: m, limit on its depth. */
static void sum_faces(const knurl_joint_search *m, const knurl_active_faces *faces, uint32_t obstacle, double longest,
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
    vec3_copy(sum, o->candidate->excess);
    const double depth = vec3_normalise(sum);
    knurl_pose_to_own(o->pose, m->proxy, own);
    knurl_shape_rest(&o->surface->shape, &most->hit, own, &touched->state, &touched->contact);
    knurl_pose_vector_to_own(o->pose, sum, touched->contact.normal);
    touched->contact.z = depth < longest ? -depth : -longest;
    touched->contact.unsure = 0;
    touched->contact.facet = NULL;
    touched->parts.count = 0;
    if (o->surface->shape.bulge > 0.0 && depth > 0.0) { /* else the faces cancel each other */
        for (uint32_t i = 0; i < faces->count; i++) {
            const knurl_active_face *face = &faces->list[i];
            if (face->obstacle == obstacle && face->press > 0.0) {
                double push[3];
                vec3_scale(face->press * -touched->contact.z / depth, face->hit.normal, push);
                knurl_felt_add_part(o->surface->shape.geometry, face->hit.triangle, push, face == most,
                                    &touched->parts);
            }
        }
    }
}

/* In a crease of several surfaces under 90 degrees, faces press more than the proxy is away, up to any multiple of it
 * if walls are nearly parallel, and cancel each other. Contacts of such depths would push the HIP sideways as soon
 * as one wall is softer, or begins later. So the depths are limited to the proxy's distance, and the rest
 * (`excess`) is added such that the sum is the distance itself, as if all were one mesh: of equal shares along the
 * proxy's direction and the faces' own pushes, mixed so that no contact pushes by more than the distance. */
static void share_crease(knurl_joint_search *m, double longest) {
    double most = 0.0, total = 0.0;
    for (uint32_t i = 0; i < m->near.count; i++) {
        const double press = m->touched[i].held ? vec3_length(m->near.list[i].candidate->excess) : 0.0;
        most = press > most ? press : most;
        total += press;
    }
    if (m->pressed < 2 || !(most > longest) || !(longest > 0.0)) {
        return;
    }
    const double mix = (longest / most) * (longest / most);
    for (uint32_t i = 0; i < m->near.count; i++) {
        double *excess = m->near.list[i].candidate->excess;
        const double press = m->touched[i].held ? vec3_length(excess) : 0.0;
        if (press > 0.0) {
            vec3_scale(mix - knurl_min(1.0, longest / press), excess, excess);
            vec3_madd(excess, (1.0 - mix) * longest * press / total, m->normal, excess);
            m->sharp |= (uint64_t)1 << i;
        }
    }
}

/* Turns the god-object's faces into contacts. */
static void use_god_object(knurl_joint_search *m, knurl_god_object *g) {
    double held[3];
    for (uint32_t i = 0; i < g->faces.count; i++) { /* onto the faces, instead of above them */
        g->faces.list[i].offset -= g->faces.list[i].rest;
    }
    vec3_copy(g->at, m->proxy);
    if (g->faces.count > 0 && knurl_active_faces_project(&g->faces, m->hip, held) &&
        vec3_distance2(held, g->at) < KNURL_JOINT_ROUNDING * KNURL_JOINT_ROUNDING) { /* else it has not arrived yet */
        vec3_copy(held, m->proxy);
    }
    vec3_sub(m->proxy, m->hip, m->normal);
    const double longest = vec3_normalise(m->normal);
    for (uint32_t i = 0; i < m->near.count; i++) {
        sum_faces(m, &g->faces, i, longest, &m->touched[i]);
        m->pressed += (uint32_t)m->touched[i].held;
    }
    share_crease(m, longest);
    vec3_copy(g->at, m->proxy);
    if (g->faces.count > 0 && m->pressed == 0) { /* touching, without depth */
        m->pressed = 2;
    }
}

/* m: highest step between two surfaces, with nothing in between, over which the HIP passes from one to the other. */
#define STEP_HEIGHT 1e-3

/* The HIP has just slipped off a rim: looks above it for a surface that continues there, beyond a small step or crack.
 */
static void find_next(knurl_joint_search *m, knurl_god_object *g) {
    const knurl_slip *slip = &m->contacts->slip;
    double up[3];
    double above[3];
    vec3_sub(slip->proxy, m->hip, above);
    const double depth = vec3_dot(above, slip->normal);
    if (!(depth > 0.0)) {
        return;
    }
    vec3_madd(slip->proxy, STEP_HEIGHT, slip->normal, up);
    vec3_madd(m->hip, depth + STEP_HEIGHT, slip->normal, above);
    knurl_hip_path path = *m->path;
    path.proxy = above;
    knurl_hip_path_bound(&path);
    knurl_joint_collect(m, &path, sqrt(vec3_distance2(above, m->hip)));
    const knurl_segment rise = {slip->proxy, up, 0, KNURL_NO_OBSTACLE};
    const knurl_segment across = {up, above, 0, KNURL_NO_OBSTACLE};
    if (knurl_obstacles_are_clear(&m->near, &rise) && knurl_obstacles_are_clear(&m->near, &across)) {
        (void)knurl_god_object_step_down(g, &m->near, above, slip->normal, m->hip);
    }
}

/* Records a slip off a rim, if contact ended although the HIP did not leave through the front. */
static void note_slip(knurl_contacts *c, const double hip[3]) {
    double way[3];
    vec3_sub(hip, c->proxy.at, way);
    if (vec3_dot(way, c->proxy.normal) < -KNURL_JOINT_ROUNDING) {
        c->slip.time = c->clock.time;
        c->slip.ramped_depth = c->proxy.ramped_depth;
        vec3_copy(c->proxy.at, c->slip.proxy);
        vec3_copy(c->proxy.normal, c->slip.normal);
    }
}

/* 1 if a surface that held the HIP is still in the scene; a HIP cannot slip off a removed one. */
static int has_holder(const knurl_joint_search *m) {
    int has = 0;
    for (uint32_t i = 0; i < m->near.count; i++) {
        has |= m->near.list[i].candidate->contact.inside;
    }
    return has;
}

/* 1 if parts of the mesh intersect or touch: then the god-object's faces are preferred to the shape's own contact. */
static int has_parts(const knurl_touched *touched) {
    return (touched->contact.unsure & KNURL_UNSURE_PARTS) != 0;
}

/* m: length of a proxy's path in a tick after one that ran out of visits; half as much after two, and so on. Short
 * paths are cheap, so that the proxy catches up. */
#define SHORT_WAY 0.0005

/* Moves the god-object as near to the HIP as possible; after ticks that ran out of visits, a short piece first. */
static void follow(const knurl_joint_search *m, knurl_god_object *g) {
    double way[3];
    vec3_sub(m->hip, g->at, way);
    const double length = vec3_length(way);
    const double longest = ldexp(2.0 * SHORT_WAY, -(int)m->contacts->budget.short_ticks);
    if (m->contacts->budget.short_ticks > 0 && length > longest) {
        double target[3];
        vec3_madd(g->at, longest / length, way, target);
        knurl_god_object_follow(g, &m->near, target);
        if (g->faces.count > 0) {
            return;
        }
    }
    knurl_god_object_follow(g, &m->near, m->hip);
}

void knurl_joint_search_faces(knurl_joint_search *m, uint32_t *flags) {
    knurl_contacts *c = m->contacts;
    knurl_god_object g;
    memset(&g, 0, sizeof g);
    m->pressed = 0;
    vec3_copy(c->proxy.holders ? c->proxy.at : c->previous, g.at);
    knurl_god_object_push(&g, &m->near);
    follow(m, &g);
    m->unknown = knurl_obstacles_are_unknown(&m->near) &&
                 (g.faces.count == 0 || (knurl_joint_goes_on_alone(m) && !has_parts(&m->touched[0])));
    if (m->unknown) {
        return;
    }
    if (g.faces.count == 0 && c->proxy.holders && has_holder(m)) {
        note_slip(c, m->hip);
    }
    if (g.faces.count == 0 && knurl_contacts_have_slipped(c)) {
        find_next(m, &g);
    }
    use_god_object(m, &g);
    for (uint32_t i = 0; i < m->near.count; i++) {
        if (!m->touched[i].held) {
            knurl_joint_query_crests(m, &m->near.list[i], &m->touched[i]);
        }
    }
    if (g.squeezed) {
        *flags |= KNURL_TICK_SQUEEZED;
    }
}

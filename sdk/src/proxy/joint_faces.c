/* Contact with all faces nearby at once, by a god-object. Read knurl_joint_search_faces(), at the end, first.
 * SPDX-License-Identifier: MIT */
#include "proxy/joint_faces.h"

#include "proxy/felt.h"
#include "proxy/god_object.h"

#include <string.h>

/* Adds up the pressed faces of one obstacle to its push, scene, m. */
static const knurl_active_face *sum_faces(const knurl_active_faces *faces, uint32_t obstacle, double push[3]) {
    const knurl_active_face *most = NULL;
    push[0] = push[1] = push[2] = 0.0;
    for (uint32_t i = 0; i < faces->count; i++) {
        const knurl_active_face *face = &faces->list[i];
        if (face->obstacle == obstacle && face->press > 0.0) {
            vec3_madd(push, face->press, face->normal, push);
            most = !most || face->press > most->press ? face : most;
        }
    }
    return most;
}

/* Adds the parts of a smooth mesh whose faces push to a contact of `depth` (m). summed: m, the length of their sum. */
static void add_parts(const knurl_joint_search *m, const knurl_active_faces *faces, const knurl_active_face *most,
                      double depth, double summed, knurl_touched *touched) {
    const knurl_mesh *mesh = m->near.list[most->obstacle].surface->shape.mesh;
    for (uint32_t i = 0; i < faces->count; i++) {
        const knurl_active_face *face = &faces->list[i];
        if (face->obstacle == most->obstacle && face->press > 0.0) {
            double push[3];
            vec3_scale(face->press * depth / summed, face->hit.normal, push);
            knurl_felt_add_part(mesh, face->hit.triangle, push, face == most, &touched->parts);
        }
    }
}

/* Sets an obstacle's contact from its push (scene, m), of which its faces press most at `most`. */
static void set_contact(const knurl_joint_search *m, const knurl_active_faces *faces, const knurl_active_face *most,
                        double summed, double push[3], knurl_touched *touched) {
    const knurl_obstacle *o = &m->near.list[most->obstacle];
    const double depth = vec3_normalise(push);
    double own[3];
    knurl_pose_to_own(o->pose, m->proxy, own);
    knurl_shape_rest(&o->surface->shape, &most->hit, own, &touched->state, &touched->contact);
    knurl_pose_vector_to_own(o->pose, depth > 0.0 ? push : most->normal, touched->contact.normal);
    touched->contact.z = -depth;
    touched->contact.unsure = 0;
    touched->contact.facet = NULL;
    touched->parts.count = 0;
    if (o->surface->shape.bulge > 0.0 && summed > 0.0) { /* else the faces cancel each other */
        add_parts(m, faces, most, depth, summed, touched);
    }
}

/* Shares the depth among the obstacles whose faces press, each along its own normal, such that their pushes add up to
 * it. In a crease under 90 degrees the pushes are longer than the depth, without bound as the walls become parallel,
 * and mostly cancel. If one wall is softer, or begins later, they would not cancel and would throw the HIP sideways.
 * So each push is blended with an equal share of the depth until none is longer than the depth. */
static void share_depth(knurl_joint_search *m, const knurl_active_faces *faces, double depth) {
    const knurl_active_face *most[KNURL_ACTIVE_FACES_MAX];
    double push[KNURL_ACTIVE_FACES_MAX][3], press[KNURL_ACTIVE_FACES_MAX], longest = depth, total = 0.0;
    uint32_t count = 0;
    for (uint32_t i = 0; i < m->near.count; i++) {
        double own[3];
        const knurl_active_face *face = sum_faces(faces, i, own);
        m->touched[i].held = face != NULL;
        if (face) {
            most[count] = face;
            vec3_copy(own, push[count]);
            press[count] = vec3_length(own);
            longest = knurl_max(longest, press[count]);
            total += press[count++];
        }
    }
    const double limit = longest > depth ? depth / longest : 1.0;
    const double mix = count > 1 ? limit * limit : limit;
    for (uint32_t k = 0; k < count; k++) {
        vec3_scale(mix, push[k], push[k]);
        if (count > 1 && mix < 1.0) {
            vec3_madd(push[k], (1.0 - mix) * depth * press[k] / total, m->normal, push[k]);
        }
        set_contact(m, faces, most[k], press[k], push[k], &m->touched[most[k]->obstacle]);
    }
    m->pressed += count;
    m->whole = count > 1 ? depth : 0.0;
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
    share_depth(m, &g->faces, longest);
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

/* Contact with a triangle mesh. Outside, contact begins at the nearest point, or at a triangle that the HIP crosses.
 * Inside, the proxy walks over the surface to the nearest point of its neighbourhood, tick by tick. That need not be
 * the nearest point of the mesh, which keeps the HIP on the right side of thin walls.
 * SPDX-License-Identifier: MIT */
#include "contact/mesh_contact.h"

#include "contact/facet.h"
#include "contact/mesh_query.h"
#include "contact/mesh_walk.h"

#include <string.h>

/* A HIP this far (m) off the boundary of an open mesh has slipped off it: far below any device's resolution, and more
 * than the cracks that rounding leaves between the parts of a mesh. */
#define BOUNDARY_SLACK 1e-7

/* Maximum number of parts of a mesh that a HIP is followed through in one tick. */
#define MAX_PARTS 4

/* Flags of `unsure` that hold everywhere on the mesh. */
static int32_t has_parts(const knurl_mesh *mesh) {
    return mesh->facts.touching > 0 ? KNURL_UNSURE_PARTS : 0;
}

/* Distance of a HIP beyond the boundary that its closest point is on, along the surface; along: as a vector. */
static double off_boundary(const knurl_closest_point *closest, double along[3]) {
    vec3_madd(closest->offset, -vec3_dot(closest->offset, closest->cross) / closest->cross2, closest->cross, along);
    return vec3_length(along);
}

/* Minimum cosine between the contact's normal and the mean of the faces' normals: 84 degrees, a fold of 168. Below it,
 * this is not a fold: neighbours on a double-sided mesh may face opposite ways. */
#define FOLD_COSINE_MIN 0.1

/* Moves the proxy so that a point one seam off the mesh along the contact's normal is in front of all faces around it.
 * In a fold of more than 90 degrees it could be behind one of them, and no cast would find that face again. */
static void rest_before_fold(double seam, int32_t side, const double mean[3], knurl_contact *c) {
    vec3_madd(c->proxy, seam * side, mean, c->proxy);
    vec3_madd(c->proxy, -seam, c->normal, c->proxy);
}

/* Turns a closest point into a contact seen from `side`, with normal and signed distance. 0 if the HIP has slipped over
 * the boundary of an open mesh. */
static int set_contact(const knurl_mesh *mesh, knurl_visits *visits, int32_t side, const knurl_closest_point *closest,
                       knurl_contact *c) {
    vec3_copy(closest->point, c->proxy);
    vec3_copy(closest->weights, c->weights);
    c->triangle = closest->triangle;
    c->facet = NULL;
    if (closest->feature == 7) {
        vec3_scale(side / sqrt(closest->cross2), closest->cross, c->normal);
        c->z = vec3_dot(closest->offset, c->normal);
        return 1;
    }
    double outwards[3], offset[3], mean[3];
    int boundary;
    const double distance = sqrt(closest->distance2);
    const int inside = knurl_mesh_side(mesh, closest, visits, &boundary, mean) * side < 0;
    vec3_copy(closest->offset, offset);
    if (boundary) {
        if (off_boundary(closest, outwards) > BOUNDARY_SLACK + 1e-6 * distance) {
            return 0;
        }
        vec3_madd(offset, -1.0, outwards, offset); /* a small offset beyond the boundary must not tilt the normal */
    }
    if (distance < KNURL_NORMAL_DISTANCE) {
        vec3_scale(side / sqrt(closest->cross2), closest->cross, c->normal);
    } else {
        vec3_scale((inside ? -1.0 : 1.0) / vec3_length(offset), offset, c->normal);
    }
    c->z = inside ? -distance : distance;
    if (inside && side * vec3_dot(mean, c->normal) > FOLD_COSINE_MIN) {
        rest_before_fold(mesh->facts.seam, side, mean, c);
    }
    return 1;
}

/* Contact with the nearest point of the mesh, within `radius`. */
static int contact_nearest(const knurl_mesh *mesh, const knurl_contact_query *query, double radius, int32_t side,
                           knurl_contact *c) {
    knurl_contact nearest;
    knurl_closest_point closest;
    if (!knurl_mesh_closest(mesh, query->hip, radius, query->part, query->visits, &nearest)) {
        return 0;
    }
    knurl_closest_on_triangle(mesh, nearest.triangle, query->hip, &closest);
    return set_contact(mesh, query->visits, side, &closest, c);
}

/* The HIP is in front of its proxy. If another part of the mesh lies between the two, the contact moves there: within
 * one tick the HIP has left a ridge for the next one, or has come out of one ridge inside the next. */
static int contact_in_between(const knurl_mesh *mesh, const knurl_contact_query *query, int32_t *side,
                              knurl_contact *c) {
    knurl_contact part = *c;
    int32_t last = 0;
    for (int i = 0; i < MAX_PARTS && part.z > KNURL_ON_SURFACE; i++) {
        uint32_t triangle;
        knurl_closest_point closest;
        double from[3];
        knurl_offset_towards(part.proxy, query->hip, from);
        const int32_t met =
            knurl_mesh_cross(mesh, from, query->hip, query->double_sided, query->part, query->visits, &triangle);
        if (met == 0) {
            break;
        }
        last = met;
        knurl_closest_on_triangle(mesh, triangle, query->hip, &closest);
        (void)knurl_mesh_walk(mesh, query->hip, met, query->visits, &closest);
        if (!set_contact(mesh, query->visits, met, &closest, &part)) {
            break;
        }
        if (part.z <= 0.0) {
            *side = met;
            *c = part;
            c->unsure = 1;
            return 1;
        }
    }
    if (last == 0 || !contact_nearest(mesh, query, c->z, last, &part) || !(part.z < 0.0)) {
        return 0;
    }
    *side = last;
    *c = part;
    c->unsure = 1;
    return 1;
}

/* 1 if contact continues: the HIP is behind the surface, behind another part crossed while leaving, or in reach. */
static int is_contact(const knurl_mesh *mesh, const knurl_contact_query *query, double reach, int32_t *side,
                      knurl_contact *c) {
    return c->z <= 0.0 || contact_in_between(mesh, query, side, c) || c->z <= reach;
}

/* A T-junction, a crack, or a hole smaller than the motion of a tick is not a boundary that can be felt. Projects the
 * HIP onto the boundary's face and continues on the part found there, however deep the HIP is. If there is no such
 * part, uses the nearest point of the mesh. */
static int contact_beyond_boundary(const knurl_mesh *mesh, const knurl_contact_query *query, double reach,
                                   const knurl_closest_point *boundary, int32_t *side, knurl_contact *c) {
    double at[3];
    knurl_contact other;
    knurl_closest_point closest;
    const double off = off_boundary(boundary, at);
    c->unsure = 1;
    vec3_madd(boundary->point, 1.0, at, at);
    if (knurl_mesh_closest(mesh, at, off * (1.0 - 1e-9), NULL, query->visits, &other)) {
        knurl_closest_on_triangle(mesh, other.triangle, query->hip, &closest);
        if (vec3_dot(closest.cross, boundary->cross) > 0.0) {
            (void)knurl_mesh_walk(mesh, query->hip, *side, query->visits, &closest);
            if (set_contact(mesh, query->visits, *side, &closest, c) && is_contact(mesh, query, reach, side, c)) {
                return 1;
            }
        }
    }
    return contact_nearest(mesh, query, sqrt(boundary->distance2), *side, c) && c->z <= reach;
}

/* Contact at a closest point, or on the part that continues the surface beyond its boundary. */
static int contact_at(const knurl_mesh *mesh, const knurl_contact_query *query, double reach,
                      const knurl_closest_point *closest, int32_t *side, knurl_contact *c) {
    return set_contact(mesh, query->visits, *side, closest, c)
               ? is_contact(mesh, query, reach, side, c)
               : contact_beyond_boundary(mesh, query, reach, closest, side, c);
}

/* Closest point to a HIP in front: by a walk from its last triangle, if it has one, and then by the hierarchy, which
 * has little left to search. 0 if the surface is not within `radius`. If crests are higher than a mesh is wide, all of
 * its triangles may be equally near: at most half of the visits left are spent here, the rest is for crossings. */
static int find_closest(const knurl_mesh *mesh, const knurl_contact_query *query, double radius,
                        const knurl_contact_state *state, knurl_closest_point *closest) {
    const double *hip = query->hip;
    knurl_visits half = knurl_visits_halve(query->visits);
    knurl_contact nearest;
    int found = 0;
    if (state->side != 0) {
        knurl_closest_on_triangle(mesh, state->triangle, hip, closest);
        (void)knurl_mesh_walk(mesh, hip, state->side, &half, closest);
        found = closest->distance2 <= radius * radius;
        radius = found ? sqrt(closest->distance2) * (1.0 - 1e-9) : radius;
    }
    if (knurl_mesh_closest(mesh, hip, radius, query->part, &half, &nearest)) {
        knurl_closest_on_triangle(mesh, nearest.triangle, hip, closest);
        found = 1;
    }
    knurl_visits_settle(query->visits, &half);
    return found;
}

/* Fallback if the search for a crossing was cut short: the nearest triangle within the distance that the HIP moved
 * counts as crossed if the HIP was in front of it and is now behind. Returns the side like knurl_mesh_cross(). */
static int32_t cross_nearest(const knurl_mesh *mesh, const knurl_contact_query *query, uint32_t *triangle) {
    double way[3], before[3], now[3];
    knurl_contact nearest;
    knurl_triangle t;
    vec3_sub(query->hip, query->previous, way);
    if (!knurl_mesh_closest(mesh, query->hip, vec3_length(way), query->part, query->visits, &nearest)) {
        return 0;
    }
    knurl_mesh_triangle(mesh, nearest.triangle, &t);
    vec3_sub(query->previous, t.corners[0], before);
    vec3_sub(query->hip, t.corners[0], now);
    const double from = vec3_dot(before, t.normal), to = vec3_dot(now, t.normal);
    *triangle = nearest.triangle;
    return from >= 0.0 && to < 0.0 ? 1 : query->double_sided && from <= 0.0 && to > 0.0 ? -1 : 0;
}

/* Begins contact if the HIP has crossed the surface since the last tick. */
static int begin_by_crossing(const knurl_mesh *mesh, const knurl_contact_query *query, double reach,
                             knurl_contact_state *state, knurl_contact *c) {
    uint32_t triangle;
    knurl_closest_point closest;
    knurl_visits half = knurl_visits_halve(query->visits);
    int32_t side =
        knurl_mesh_cross(mesh, query->previous, query->hip, query->double_sided, query->part, &half, &triangle);
    knurl_visits_settle(query->visits, &half);
    if (side == 0 && half.exhausted) {
        side = cross_nearest(mesh, query, &triangle);
    }
    if (side == 0) {
        if (half.exhausted && query->visits) { /* a crossing may have been missed: end the queries of this tick */
            query->visits->left = 0;
        }
        return 0;
    }
    knurl_closest_on_triangle(mesh, triangle, query->hip, &closest);
    c->unsure |= knurl_mesh_walk(mesh, query->hip, side, query->visits, &closest) | has_parts(mesh);
    if (!contact_at(mesh, query, reach, &closest, &side, c)) {
        c->unsure = 1;
        return 0;
    }
    state->side = side;
    return 1;
}

/* 1 if the HIP moved less in this tick than its distance to the surface, as found by a complete search. */
static int cannot_have_crossed(const knurl_contact_query *query, double distance2) {
    double way[3];
    vec3_sub(query->hip, query->previous, way);
    return !(query->visits && query->visits->exhausted) && vec3_dot(way, way) < distance2 * (1.0 - 1e-9);
}

/* A HIP outside: contact begins if it has crossed the surface, is in reach or, on the first tick, starts inside. A
 * double-sided surface has no inside: a HIP behind it on the first tick is simply behind. */
static int begin_contact(const knurl_mesh *mesh, const knurl_contact_query *query, double reach,
                         knurl_contact_state *state, knurl_contact *c) {
    /* the side of a HIP on the surface matters only if both sides can be touched */
    const double in_reach = query->double_sided ? reach : query->reach;
    const int captures = !query->has_previous && !query->double_sided;
    const double radius = captures ? fmax(in_reach, KNURL_CAPTURE_DEPTH) : in_reach;
    knurl_closest_point closest;
    const int was_near = state->side != 0 && find_closest(mesh, query, radius, state, &closest);
    if (query->has_previous && !(was_near && cannot_have_crossed(query, closest.distance2)) &&
        begin_by_crossing(mesh, query, reach, state, c)) {
        return 1;
    }
    if (!was_near && (!(radius > 0.0) || !find_closest(mesh, query, radius, state, &closest))) {
        return 0;
    }
    state->side = 1;
    if (!set_contact(mesh, query->visits, 1, &closest, c)) {
        return 0;
    }
    if (query->double_sided && c->z < 0.0) { /* in reach from behind */
        state->side = -1;
        return set_contact(mesh, query->visits, -1, &closest, c);
    }
    return c->z >= 0.0 ? c->z <= reach : captures;
}

/* A HIP that has just left a mesh of several parts: moves the contact to the nearest one, whose crests are felt. The
 * last proxy may lie inside another part. */
static void move_to_nearest(const knurl_mesh *mesh, const knurl_contact_query *query, int32_t side, knurl_contact *c) {
    knurl_contact nearest = *c;
    if (contact_nearest(mesh, query, c->z * (1.0 - 1e-9), side, &nearest) && nearest.z >= 0.0) {
        *c = nearest;
    }
}

/* Closest point to a HIP inside, by a walk from the last triangle. 0 if the cached facet gives the contact. */
static int walk_to_closest(const knurl_mesh *mesh, const knurl_contact_query *query, const knurl_contact_state *state,
                           knurl_closest_point *closest, knurl_contact *c) {
    knurl_facet *facet = query->facet;
    const int is_kept = facet && facet->triangle == state->triangle && facet->side == state->side;
    double inside[2];
    const int is_above = is_kept && knurl_facet_contact(facet, query->hip, inside, c);
    if (is_above && c->z <= 0.0) {
        c->facet = facet;
        return 0;
    }
    if (is_kept && !is_above) {
        knurl_facet_edges(facet, query->hip, inside, closest);
    } else {
        knurl_closest_on_triangle(mesh, state->triangle, query->hip, closest);
    }
    if (closest->feature != 7) {
        c->unsure |= knurl_mesh_walk(mesh, query->hip, state->side, query->visits, closest);
    }
    return 1;
}

/* A HIP inside: the proxy follows it. Its triangle is cached, because it often stays there for some ticks. */
static int hold_contact(const knurl_mesh *mesh, const knurl_contact_query *query, double reach,
                        knurl_contact_state *state, knurl_contact *c) {
    knurl_closest_point closest;
    if (!walk_to_closest(mesh, query, state, &closest, c)) {
        return 1;
    }
    const int is_set = set_contact(mesh, query->visits, state->side, &closest, c);
    if (is_set && c->z <= 0.0) {
        if (query->facet && closest.feature == 7) {
            knurl_facet_keep(&closest, state->side, c->normal, query->facet);
            c->facet = query->facet;
        }
        return 1;
    }
    const int held = is_set ? is_contact(mesh, query, reach, &state->side, c)
                            : contact_beyond_boundary(mesh, query, reach, &closest, &state->side, c);
    if (held && c->z > KNURL_ON_SURFACE && mesh->facts.touching > 0) {
        move_to_nearest(mesh, query, state->side, c);
    }
    return held;
}

int knurl_mesh_contact(const knurl_mesh *mesh, const knurl_contact_query *query, knurl_contact_state *state,
                       knurl_contact *contact) {
    const double reach = query->reach > KNURL_ON_SURFACE ? query->reach : KNURL_ON_SURFACE; /* fmax() is slower */
    const int32_t was_inside = state->inside;
    contact->unsure = 0;
    const int held = was_inside ? hold_contact(mesh, query, reach, state, contact)
                                : begin_contact(mesh, query, reach, state, contact);
    if (!held || contact->z > reach) {
        contact->unsure |= was_inside ? (held ? 0 : 1) | has_parts(mesh) : 0;
        memset(state, 0, sizeof *state);
        return 0;
    }
    state->inside = contact->z <= KNURL_ON_SURFACE;
    contact->unsure |= (was_inside | state->inside) ? has_parts(mesh) : 0;
    state->triangle = contact->triangle;
    return 1;
}

/* The proxy on a triangle mesh. In front of the surface a HIP is watched by nearest point and by what its path crosses;
 * inside, the proxy walks over the surface to the nearest point of its neighbourhood, tick by tick, so that a thin wall
 * or the far side of a body never catches it. It may then rest on a facet that is not the nearest of all: that is what
 * tells the front of a wall from its back.
 * SPDX-License-Identifier: MIT */
#include "contact/mesh_contact.h"

#include "contact/mesh_query.h"
#include "contact/mesh_walk.h"

#include <string.h>

/* Further than this (m) off the rim of an open mesh a HIP has slipped off it: far below any device's resolution, and
 * more than the cracks that rounding leaves between the parts of a mesh. */
#define RIM 1e-7

/* Parts of a mesh that one way of a HIP is followed through in a tick, at most. */
#define MAX_PARTS 4

/* How far a HIP is off the rim that its foot is on, along the surface. */
static double off_the_rim(const knurl_foot *foot, double along[3]) {
    vec3_madd(foot->offset, -vec3_dot(foot->offset, foot->normal) / foot->area2, foot->normal, along);
    return vec3_length(along);
}

/* Turns a foot into a contact seen from `side`: its normal, its signed distance. 0 where the HIP has slipped over the
 * rim of an open mesh. */
static int finish(const knurl_mesh *mesh, int32_t side, const knurl_foot *foot, knurl_contact *c) {
    vec3_copy(foot->point, c->proxy);
    vec3_copy(foot->weights, c->weights);
    c->triangle = foot->triangle;
    if (foot->held == 7) {
        vec3_scale(side / sqrt(foot->area2), foot->normal, c->normal);
        c->z = vec3_dot(foot->offset, c->normal);
        return 1;
    }
    double outwards[3], offset[3];
    int rim;
    const double distance = sqrt(foot->distance2);
    const int inside = knurl_foot_side(mesh, foot, &rim) * side < 0;
    vec3_copy(foot->offset, offset);
    if (rim) {
        if (off_the_rim(foot, outwards) > RIM + 1e-6 * distance) {
            return 0;
        }
        vec3_madd(offset, -1.0, outwards, offset); /* what little is off it does not tilt the normal */
    }
    if (distance < KNURL_NORMAL_DISTANCE) {
        vec3_scale(side / sqrt(foot->area2), foot->normal, c->normal);
    } else {
        vec3_scale((inside ? -1.0 : 1.0) / vec3_length(offset), offset, c->normal);
    }
    c->z = inside ? -distance : distance;
    return 1;
}

/* The contact with what is nearest of all, within `radius`. */
static int touch_nearest(const knurl_mesh *mesh, const double hip[3], double radius, int32_t side, knurl_contact *c) {
    knurl_contact nearest;
    knurl_foot foot;
    if (!knurl_mesh_closest(mesh, hip, radius, &nearest)) {
        return 0;
    }
    knurl_foot_find(mesh, nearest.triangle, hip, &foot);
    return finish(mesh, side, &foot, c);
}

/* The HIP is in front of its proxy: is another part of the mesh between the two? Then that part holds it: within one
 * tick it has left a ridge for the next one, or the ridge that held it has let go of it inside the next. */
static int held_by_another(const knurl_mesh *mesh, const knurl_contact_query *query, int32_t *side, knurl_contact *c) {
    knurl_contact part = *c;
    int32_t last = 0;
    for (int i = 0; i < MAX_PARTS && part.z > KNURL_ON_SURFACE; i++) {
        uint32_t triangle;
        knurl_foot foot;
        double from[3];
        knurl_foot_leave(part.proxy, query->hip, from);
        const int32_t met = knurl_mesh_cross(mesh, from, query->hip, query->double_sided, &triangle);
        if (met == 0) {
            break;
        }
        last = met;
        knurl_foot_find(mesh, triangle, query->hip, &foot);
        knurl_foot_walk(mesh, query->hip, met, &foot);
        if (!finish(mesh, met, &foot, &part)) {
            break;
        }
        if (part.z <= 0.0) {
            *side = met;
            *c = part;
            return 1;
        }
    }
    if (last == 0 || !touch_nearest(mesh, query->hip, c->z, last, &part) || !(part.z < 0.0)) {
        return 0;
    }
    *side = last;
    *c = part;
    return 1;
}

/* Whether a contact is one: the HIP is behind it, behind another part of the mesh that it met on its way out, or in
 * reach. */
static int stands(const knurl_mesh *mesh, const knurl_contact_query *query, double reach, int32_t *side,
                  knurl_contact *c) {
    return c->z <= 0.0 || held_by_another(mesh, query, side, c) || c->z <= reach;
}

/* Where a surface ends in its middle (T-junctions, cracks, holes that a tick leads across) it goes on in another part:
 * that is where the HIP, moved back along its proxy's face, meets it, however deep it is. Else what is nearest has it.
 */
static int beyond_the_rim(const knurl_mesh *mesh, const knurl_contact_query *query, double reach, const knurl_foot *rim,
                          int32_t *side, knurl_contact *c) {
    double at[3];
    knurl_contact other;
    knurl_foot foot;
    const double off = off_the_rim(rim, at);
    vec3_madd(rim->point, 1.0, at, at);
    if (knurl_mesh_closest(mesh, at, off * (1.0 - 1e-9), &other)) {
        knurl_foot_find(mesh, other.triangle, query->hip, &foot);
        if (vec3_dot(foot.normal, rim->normal) > 0.0) {
            knurl_foot_walk(mesh, query->hip, *side, &foot);
            if (finish(mesh, *side, &foot, c) && stands(mesh, query, reach, side, c)) {
                return 1;
            }
        }
    }
    return touch_nearest(mesh, query->hip, sqrt(rim->distance2), *side, c) && c->z <= reach;
}

/* The contact with the surface that a foot is on, or goes on on. */
static int touch(const knurl_mesh *mesh, const knurl_contact_query *query, double reach, const knurl_foot *foot,
                 int32_t *side, knurl_contact *c) {
    return finish(mesh, *side, foot, c) ? stands(mesh, query, reach, side, c)
                                        : beyond_the_rim(mesh, query, reach, foot, side, c);
}

/* The foot of a HIP in front: from where it was a tick ago, if there was one, and by the hierarchy, which then has
 * little to look at. 0 where there is none within `radius`. */
static int find_near(const knurl_mesh *mesh, const double hip[3], double radius, const knurl_contact_state *state,
                     knurl_foot *foot) {
    knurl_contact nearest;
    int found = 0;
    if (state->side != 0) {
        knurl_foot_find(mesh, state->triangle, hip, foot);
        knurl_foot_walk(mesh, hip, state->side, foot);
        found = foot->distance2 <= radius * radius;
        radius = found ? sqrt(foot->distance2) * (1.0 - 1e-9) : radius;
    }
    if (knurl_mesh_closest(mesh, hip, radius, &nearest)) {
        knurl_foot_find(mesh, nearest.triangle, hip, foot);
        found = 1;
    }
    return found;
}

/* Has the HIP come through the surface since the last tick? */
static int come_through(const knurl_mesh *mesh, const knurl_contact_query *query, double reach,
                        knurl_contact_state *state, knurl_contact *c) {
    uint32_t triangle;
    knurl_foot foot;
    int32_t side = knurl_mesh_cross(mesh, query->previous, query->hip, query->double_sided, &triangle);
    if (side == 0) {
        return 0;
    }
    knurl_foot_find(mesh, triangle, query->hip, &foot);
    knurl_foot_walk(mesh, query->hip, side, &foot);
    if (!touch(mesh, query, reach, &foot, &side, c)) {
        return 0;
    }
    state->side = side;
    return 1;
}

/* Whether a HIP's way in this tick stayed within what is nearest to it: then it has crossed nothing. */
static int moved_less(const knurl_contact_query *query, double distance2) {
    double way[3];
    vec3_sub(query->hip, query->previous, way);
    return vec3_dot(way, way) < distance2 * (1.0 - 1e-9);
}

/* A HIP outside: has it come through, is it in reach, or (first tick) was it pressed in from the start? A double-sided
 * surface has no inside: there, a HIP behind it on a first tick is simply behind. */
static int watch(const knurl_mesh *mesh, const knurl_contact_query *query, double reach, knurl_contact_state *state,
                 knurl_contact *c) {
    /* which side a HIP on the surface came from matters only where both can be touched */
    const double in_reach = query->double_sided ? reach : query->reach;
    const int captures = !query->has_previous && !query->double_sided;
    const double radius = captures ? fmax(in_reach, KNURL_CAPTURE_DEPTH) : in_reach;
    knurl_foot foot;
    const int was_near = state->side != 0 && find_near(mesh, query->hip, radius, state, &foot);
    if (query->has_previous && !(was_near && moved_less(query, foot.distance2)) &&
        come_through(mesh, query, reach, state, c)) {
        return 1;
    }
    if (!was_near && (!(radius > 0.0) || !find_near(mesh, query->hip, radius, state, &foot))) {
        return 0;
    }
    state->side = 1;
    if (!finish(mesh, 1, &foot, c)) {
        return 0;
    }
    if (query->double_sided && c->z < 0.0) { /* in reach from behind */
        state->side = -1;
        return finish(mesh, -1, &foot, c);
    }
    return c->z >= 0.0 ? c->z <= reach : captures;
}

/* A HIP inside: the proxy walks after it. */
static int follow(const knurl_mesh *mesh, const knurl_contact_query *query, double reach, knurl_contact_state *state,
                  knurl_contact *c) {
    knurl_foot foot;
    knurl_foot_find(mesh, state->triangle, query->hip, &foot);
    if (foot.held != 7) {
        knurl_foot_walk(mesh, query->hip, state->side, &foot);
    }
    return touch(mesh, query, reach, &foot, &state->side, c);
}

int knurl_mesh_contact(const knurl_mesh *mesh, const knurl_contact_query *query, knurl_contact_state *state,
                       knurl_contact *contact) {
    const double reach = query->reach > KNURL_ON_SURFACE ? query->reach : KNURL_ON_SURFACE; /* fmax() is a call */
    const int held =
        state->inside ? follow(mesh, query, reach, state, contact) : watch(mesh, query, reach, state, contact);
    if (!held || contact->z > reach) {
        memset(state, 0, sizeof *state);
        return 0;
    }
    state->inside = contact->z <= KNURL_ON_SURFACE;
    state->triangle = contact->triangle;
    return 1;
}

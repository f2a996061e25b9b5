/* The proxy on a triangle mesh. In front of the surface a HIP is watched by nearest point and by what its path crosses;
 * inside, the proxy walks over the surface to the nearest point of its neighbourhood, tick by tick, so that a thin wall
 * or the far side of a body never catches it. SPDX-License-Identifier: MIT */
#include "contact/contact.h"

#include "contact/triangle.h"

#include <string.h>

/* Steps of one walk. A stroke of 1 m/s crosses a few triangles a tick; an uncapped teleport over a fine mesh would take
 * thousands. A walk that ends early goes on at the next tick. */
#define MAX_STEPS 64

/* Further than this (m) off the rim of an open mesh a HIP has slipped off it: far below any device's resolution. */
#define RIM 1e-9

/* Vertices of very many triangles (the pole of a sphere, the hub of a fan) are looked at in part; a walk that came by
 * one asks the hierarchy whether it missed anything nearer. */
#define MAX_FAN 256

static uint32_t weld_of(const knurl_mesh *mesh, uint32_t triangle, uint32_t corner) {
    return mesh->welds[mesh->triangles[3 * (size_t)triangle + corner]];
}

static uint32_t fan_of(const knurl_mesh *mesh, uint32_t vertex, const uint32_t **fan) {
    const uint32_t start = mesh->fan_starts[vertex];
    const uint32_t size = mesh->fan_starts[vertex + 1] - start;
    *fan = &mesh->fans[start];
    return size < MAX_FAN ? size : MAX_FAN;
}

/* The nearest point of one triangle as a contact; returns the squared distance. */
static double nearest_on(const knurl_mesh *mesh, uint32_t triangle, const double hip[3], knurl_contact *c) {
    knurl_triangle t;
    double offset[3];
    knurl_mesh_triangle(mesh, triangle, &t);
    triangle_nearest((const double (*)[3])t.corners, hip, c->weights);
    triangle_point((const double (*)[3])t.corners, c->weights, c->proxy);
    vec3_copy(t.normal, c->normal);
    c->triangle = triangle;
    vec3_sub(hip, c->proxy, offset);
    return vec3_dot(offset, offset);
}

/* From a triangle downhill to the local minimum of the distance, over whole fans and only where it is strictly nearer
 * (walking edges alone goes wrong in concave corners). */
static double walk(const knurl_mesh *mesh, uint32_t start, const double hip[3], knurl_contact *c) {
    double best2 = nearest_on(mesh, start, hip, c);
    int capped = 0;
    for (int step = 0; step < MAX_STEPS; step++) {
        const uint32_t here = c->triangle;
        const double before2 = best2;
        for (uint32_t corner = 0; corner < 3; corner++) {
            const uint32_t *fan;
            if (c->triangle != here || c->weights[corner] == 0.0 ||
                c->weights[0] * c->weights[1] * c->weights[2] != 0.0) {
                continue; /* only round the corners that the point rests on; none round an inner point */
            }
            const uint32_t count = fan_of(mesh, weld_of(mesh, here, corner), &fan);
            capped |= count == MAX_FAN;
            for (uint32_t i = 0; i < count; i++) {
                knurl_contact other;
                const double distance2 = nearest_on(mesh, fan[i], hip, &other);
                if (distance2 < best2 * (1.0 - 1e-12)) {
                    best2 = distance2;
                    *c = other;
                }
            }
        }
        if (!(best2 < before2)) {
            break;
        }
    }
    knurl_contact other;
    if (capped && knurl_mesh_closest(mesh, hip, sqrt(best2) * (1.0 - 1e-9), &other)) {
        best2 = nearest_on(mesh, other.triangle, hip, c);
    }
    return best2;
}

/* How many triangles share the edge between two welded vertices. */
static int edge_users(const knurl_mesh *mesh, uint32_t a, uint32_t b) {
    const uint32_t *fan;
    const uint32_t *fan_b;
    uint32_t count = fan_of(mesh, a, &fan);
    const uint32_t count_b = fan_of(mesh, b, &fan_b);
    if (count_b < count) { /* from its less crowded end, which no cap cuts short */
        fan = fan_b;
        count = count_b;
        b = a;
    }
    int users = 0;
    for (uint32_t i = 0; i < count; i++) {
        users += weld_of(mesh, fan[i], 0) == b || weld_of(mesh, fan[i], 1) == b || weld_of(mesh, fan[i], 2) == b;
    }
    return users;
}

/* Whether a proxy on an edge or a corner is on the rim of an open mesh. */
static int on_rim(const knurl_mesh *mesh, const knurl_contact *c) {
    uint32_t held[3] = {0, 0, 0};
    uint32_t count = 0;
    for (uint32_t corner = 0; corner < 3; corner++) {
        if (c->weights[corner] != 0.0) {
            held[count++] = weld_of(mesh, c->triangle, corner);
        }
    }
    if (count == 3) {
        return 0;
    }
    if (count == 2) {
        return edge_users(mesh, held[0], held[1]) == 1;
    }
    const uint32_t *fan;
    const uint32_t size = fan_of(mesh, held[0], &fan);
    for (uint32_t i = 0; i < size && size < MAX_FAN; i++) {
        for (uint32_t corner = 0; corner < 3; corner++) {
            const uint32_t other = weld_of(mesh, fan[i], corner);
            if (other != held[0] && edge_users(mesh, held[0], other) == 1) {
                return 1;
            }
        }
    }
    return 0;
}

/* The angle-weighted normal at a proxy: its dot product with the offset has the right sign wherever on the mesh the
 * nearest point lies (Baerentzen and Aanaes 2005); one face's normal has not, at edges and corners. */
static void pseudonormal(const knurl_mesh *mesh, const knurl_contact *c, double out[3]) {
    uint32_t corner = c->weights[0] == 1.0 ? 0 : c->weights[1] == 1.0 ? 1 : 2;
    const int at_vertex = c->weights[corner] == 1.0;
    if (!at_vertex && c->weights[0] * c->weights[1] * c->weights[2] != 0.0) {
        vec3_copy(c->normal, out);
        return;
    }
    corner = at_vertex || c->weights[corner] != 0.0 ? corner : 0;
    const uint32_t vertex = weld_of(mesh, c->triangle, corner);
    const uint32_t next =
        weld_of(mesh, c->triangle, c->weights[(corner + 1) % 3] != 0.0 ? (corner + 1) % 3 : (corner + 2) % 3);
    const uint32_t *fan;
    const uint32_t count = fan_of(mesh, vertex, &fan);
    out[0] = out[1] = out[2] = 0.0;
    for (uint32_t i = 0; i < count; i++) {
        knurl_triangle t;
        double to_next[3];
        double to_last[3];
        uint32_t k = 0;
        while (k < 2 && weld_of(mesh, fan[i], k) != vertex) {
            k++;
        }
        const int has_next = weld_of(mesh, fan[i], (k + 1) % 3) == next || weld_of(mesh, fan[i], (k + 2) % 3) == next;
        knurl_mesh_triangle(mesh, fan[i], &t);
        vec3_sub(t.corners[(k + 1) % 3], t.corners[k], to_next);
        vec3_sub(t.corners[(k + 2) % 3], t.corners[k], to_last);
        vec3_normalise(to_next);
        vec3_normalise(to_last);
        const double cosine = fmax(-1.0, fmin(1.0, vec3_dot(to_next, to_last)));
        vec3_madd(out, at_vertex ? acos(cosine) : has_next, t.normal, out);
    }
}

/* Turns a nearest point into a contact seen from `side`: its normal, its signed distance. 0 where the HIP has slipped
 * over the rim of an open mesh. */
static int finish(const knurl_mesh *mesh, const double hip[3], int32_t side, knurl_contact *c) {
    double offset[3];
    double face[3];
    double normal[3];
    vec3_scale(side, c->normal, face);
    vec3_sub(hip, c->proxy, offset);
    const double distance = vec3_length(offset);
    if (distance < KNURL_NORMAL_DISTANCE) {
        vec3_copy(face, c->normal);
        c->z = vec3_dot(offset, face);
        return 1;
    }
    pseudonormal(mesh, c, normal);
    const int inside = vec3_dot(offset, normal) * side < 0.0;
    const double along = vec3_dot(offset, face);
    if (sqrt(fmax(0.0, distance * distance - along * along)) > RIM + 1e-6 * distance && on_rim(mesh, c)) {
        return 0;
    }
    vec3_scale((inside ? -1.0 : 1.0) / distance, offset, c->normal);
    c->z = inside ? -distance : distance;
    return 1;
}

/* Fills in a triangle's own normal at a nearest point that a query of the hierarchy found. */
static void face_normal(const knurl_mesh *mesh, knurl_contact *c) {
    knurl_triangle t;
    knurl_mesh_triangle(mesh, c->triangle, &t);
    vec3_copy(t.normal, c->normal);
}

/* The HIP is in front of its proxy: is another part of the mesh between the two? Then that part holds it: within one
 * tick it has left a ridge for the next one, or the ridge that held it has let go of it inside the next. */
static int held_by_another(const knurl_mesh *mesh, const double hip[3], int32_t side, knurl_contact *c) {
    knurl_contact other;
    uint32_t triangle;
    double offset[3];
    vec3_sub(hip, c->proxy, offset);
    if (knurl_mesh_cross(mesh, c->proxy, hip, side < 0, &triangle) != side ||
        !knurl_mesh_closest(mesh, hip, vec3_length(offset), &other)) {
        return 0;
    }
    face_normal(mesh, &other);
    if (!finish(mesh, hip, side, &other) || other.z >= 0.0) {
        return 0;
    }
    *c = other;
    return 1;
}

/* A HIP outside: has it come through, is it in reach, or (first tick) was it pressed in from the start? */
static int watch(const knurl_mesh *mesh, const knurl_contact_query *query, double reach, knurl_contact_state *state,
                 knurl_contact *c) {
    const double *hip = query->hip;
    if (query->has_previous) {
        state->side = knurl_mesh_cross(mesh, query->previous, hip, query->double_sided, &state->triangle);
        if (state->side != 0) {
            (void)walk(mesh, state->triangle, hip, c);
            if (finish(mesh, hip, state->side, c) &&
                ((c->z > 0.0 && held_by_another(mesh, hip, state->side, c)) || c->z <= reach)) {
                return 1;
            }
        }
    }
    /* which side a HIP on the surface came from matters only where both can be touched */
    const double in_reach = query->double_sided ? reach : query->reach;
    const double radius = query->has_previous ? in_reach : fmax(in_reach, KNURL_CAPTURE_DEPTH);
    if (!(radius > 0.0) || !knurl_mesh_closest(mesh, hip, radius, c)) {
        return 0;
    }
    face_normal(mesh, c);
    state->side = 1;
    if (!finish(mesh, hip, 1, c)) {
        return 0;
    }
    if (query->double_sided && query->has_previous && c->z < 0.0) { /* in reach from behind */
        state->side = -1;
        face_normal(mesh, c);
        return finish(mesh, hip, -1, c);
    }
    return c->z >= 0.0 ? c->z <= reach : !query->has_previous;
}

/* A HIP inside: the proxy walks after it. Over the rim it may still be held by another part (meshes with T-junctions
 * have rims in their middle). */
static int follow(const knurl_mesh *mesh, const knurl_contact_query *query, double reach,
                  const knurl_contact_state *state, knurl_contact *c) {
    const double *hip = query->hip;
    const double distance2 = walk(mesh, state->triangle, hip, c);
    if (finish(mesh, hip, state->side, c)) {
        return c->z <= 0.0 || held_by_another(mesh, hip, state->side, c) || c->z <= reach;
    }
    if (knurl_mesh_closest(mesh, hip, sqrt(distance2), c)) {
        face_normal(mesh, c);
        return finish(mesh, hip, state->side, c) && c->z < 0.0;
    }
    return 0;
}

int knurl_mesh_contact(const knurl_mesh *mesh, const knurl_contact_query *query, knurl_contact_state *state,
                       knurl_contact *contact) {
    const double reach = fmax(query->reach, KNURL_ON_SURFACE);
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

/* Moves the closest point over a mesh: from an edge to the triangle beyond it, from a vertex to the triangles around
 * it, and only to a strictly nearer point, so that it ends. Edges alone would fail in concave corners.
 * SPDX-License-Identifier: MIT */
#include "contact/mesh_walk.h"

#include "base/base.h"
#include "contact/corner.h"
#include "contact/mesh_query.h"

/* Maximum steps of a walk. A stroke of 1 m/s crosses a few triangles per tick, a teleport over a fine mesh
 * thousands. */
#define MAX_STEPS 64

/* Limits for vertices with very many triangles (the pole of a sphere, the hub of a fan): triangles tested for the next
 * step, and triangles that determine the side. */
#define MAX_FAN  1024
#define MAX_SIDE 256

/* After FAN_STEPS steps, a walk checks if it is circling a vertex with at least FAN_MIN triangles. */
#define FAN_STEPS 16
#define FAN_MIN   32

/* State of a walk. */
typedef struct walk {
    const knurl_mesh *mesh;
    const double *p;
    knurl_visits *visits;
    int32_t side;
    int capped; /* 1: cut short */
} walk;

static int is_closer(const knurl_closest_point *a, const knurl_closest_point *b) {
    return a->distance2 < b->distance2 * (1.0 - 1e-12);
}

/* A corner of the feature: the vertex, or one end of the edge. */
static uint32_t feature_corner(const knurl_closest_point *closest) {
    return closest->feature & 1 ? 0 : closest->feature & 2 ? 1 : 2;
}

static int at_vertex(const knurl_closest_point *closest) {
    return (closest->feature & (closest->feature - 1)) == 0;
}

/* The corner opposite the feature, which is an edge. */
static uint32_t opposite_corner(const knurl_closest_point *closest) {
    return closest->feature == 3 ? 2 : closest->feature == 5 ? 1 : 0;
}

static void vertex_of(const knurl_mesh *mesh, uint32_t corner, double out[3]) {
    const float *p = &mesh->positions[3 * (size_t)mesh->triangles[corner_slot(corner)]];
    out[0] = (double)p[0];
    out[1] = (double)p[1];
    out[2] = (double)p[2];
}

/* Prefetches the neighbours of a triangle: in a mesh larger than the caches, a walk would mostly wait for memory. */
KNURL_PREFETCHING void fetch_neighbours(const knurl_mesh *mesh, uint32_t triangle) {
    const uint32_t *beyond = &mesh->opposite[3 * (size_t)triangle];
    for (int k = 0; k < 3; k++) {
        const size_t next = 3 * (size_t)((beyond[k] & KNURL_CORNER_MASK) >> 2); /* at a boundary: some other triangle */
        __builtin_prefetch(&mesh->opposite[next]);
        __builtin_prefetch(&mesh->triangles[next]);
    }
}

/* 1 if the triangle beyond the feature has a closer point. It can have one only if its far corner lies towards p. */
static int closer_beyond(walk *w, uint32_t apex, const knurl_closest_point *from, knurl_closest_point *to) {
    double corner[3];
    __builtin_prefetch(&w->mesh->opposite[3 * (size_t)(apex >> 2)]);
    vertex_of(w->mesh, apex, corner);
    vec3_sub(corner, from->point, corner);
    if (!(vec3_dot(corner, from->offset) > 0.0)) {
        return 0;
    }
    if (!knurl_visits_take(w->visits, KNURL_VISITS_STEP)) {
        w->capped = 1;
        return 0;
    }
    fetch_neighbours(w->mesh, apex >> 2);
    knurl_closest_on_triangle(w->mesh, apex >> 2, w->p, to);
    return is_closer(to, from);
}

/* 1 if a corner's triangle shares the edge or vertex that is the feature. */
static int shares_feature(const knurl_mesh *mesh, uint32_t corner, const knurl_closest_point *closest) {
    double own[3][3];
    knurl_mesh_corners(mesh, corner >> 2, own);
    for (int k = 0; k < 3; k++) {
        const double *shared = closest->corners[k];
        int found = !(closest->feature & 1u << k);
        for (int i = 0; i < 3; i++) {
            found |= own[i][0] == shared[0] && own[i][1] == shared[1] && own[i][2] == shared[2];
        }
        if (!found) {
            return 0;
        }
    }
    return 1;
}

/* Score of a triangle as the continuation of another: 1 to 3, by the angle between the two, if p is behind it; else
 * minus its squared distance. -HUGE_VAL for an inner wall that p is just crossing. */
static double continues(const knurl_closest_point *from, const knurl_closest_point *to, int32_t side) {
    const double along = vec3_dot(to->cross, to->offset) * side;
    if (along * along <= KNURL_ON_SURFACE * KNURL_ON_SURFACE * to->cross2) {
        return -HUGE_VAL;
    }
    return along < 0.0 ? 2.0 + vec3_dot(to->cross, from->cross) / sqrt(to->cross2 * from->cross2) : -to->distance2;
}

/* Finds the listed corners of a non-manifold vertex; returns their number, at most MAX_SIDE. */
static uint32_t corners_at(const knurl_mesh *mesh, const knurl_closest_point *closest, const uint32_t **corners) {
    const uint32_t vertex = mesh->triangles[3 * (size_t)closest->triangle + feature_corner(closest)];
    const knurl_vertex_corners *vertex_corners = &mesh->non_manifold[corner_find_non_manifold(mesh, vertex)];
    *corners = &mesh->non_manifold_corners[vertex_corners->first];
    return vertex_corners->count < MAX_SIDE ? vertex_corners->count : MAX_SIDE;
}

/* At a branch the surface continues straight ahead: an inner wall below it does not take over the proxy. */
static int step_at_non_manifold(walk *w, const knurl_closest_point *from, knurl_closest_point *to) {
    const uint32_t *corners;
    const uint32_t count = corners_at(w->mesh, from, &corners);
    double best = -HUGE_VAL;
    int found = 0;
    if (!knurl_visits_take(w->visits, (1 + KNURL_VISITS_CLOSEST) * count)) {
        w->capped = 1;
        return 0;
    }
    w->capped |= count == MAX_SIDE;
    for (uint32_t i = 0; i < count; i++) {
        knurl_closest_point other;
        knurl_closest_on_triangle(w->mesh, corners[i] >> 2, w->p, &other);
        if (!is_closer(&other, from) || !shares_feature(w->mesh, corners[i], from)) {
            continue;
        }
        const double score = continues(from, &other, w->side);
        if (score > best) {
            best = score;
            *to = other;
            found = 1;
        }
    }
    return found;
}

/* Tests the fan round a vertex, in both directions if it is open. */
static int step_round_vertex(walk *w, const knurl_closest_point *from, knurl_closest_point *to) {
    const uint32_t start = 4 * from->triangle + feature_corner(from);
    const knurl_swing ways[2] = {{start, corner_next(start)}, {start, corner_last(start)}};
    uint32_t seen = 1;
    for (int way = 0; way < 2; way++) {
        knurl_swing s = ways[way];
        for (;;) {
            const uint32_t apex = corner_swing(w->mesh, &s);
            if ((apex & 3) == 3) {
                break; /* a boundary */
            }
            if (s.corner == start) {
                return 0;
            }
            if (closer_beyond(w, apex, from, to)) {
                return 1;
            }
            if (++seen == MAX_FAN || !knurl_visits_take(w->visits, 1)) {
                w->capped = 1;
                return 0;
            }
        }
    }
    return 0;
}

/* One step downhill; 0 at a local minimum. */
static int step(walk *w, const knurl_closest_point *from, knurl_closest_point *to) {
    const knurl_mesh *mesh = w->mesh;
    if (from->feature == 7) {
        return 0;
    }
    if (at_vertex(from)) {
        const size_t slot = 3 * (size_t)from->triangle + feature_corner(from);
        return mesh->opposite[slot] & KNURL_NON_MANIFOLD ? step_at_non_manifold(w, from, to)
                                                         : step_round_vertex(w, from, to);
    }
    const uint32_t apex = mesh->opposite[3 * (size_t)from->triangle + opposite_corner(from)] & KNURL_CORNER_MASK;
    if ((apex & 3) == 3) {
        return apex == KNURL_NON_MANIFOLD_EDGE && step_at_non_manifold(w, from, to);
    }
    return closer_beyond(w, apex, from, to);
}

/* Sums over the triangles round a feature, to find the side that p is on. */
typedef struct side_sums {
    const knurl_mesh *mesh;
    const knurl_closest_point *closest;
    knurl_visits *visits;
    int front, back; /* 1: p is in front of a triangle, behind one */
    int oblique;     /* 1: a normal is more than 37 degrees off the offset; 0.64 is the square of the cosine */
    double weighted; /* sum of cosines, weighted by angle at a vertex, equally on an edge */
    double mean[3];  /* sum of unit normals, with the same weights */
} side_sums;

/* Adds a triangle, or nothing if the visits are used up. */
static void add_triangle(side_sums *sums, uint32_t corner, int weigh) {
    double c[3][3];
    double next[3], last[3], normal[3];
    if (!knurl_visits_take(sums->visits, 1)) {
        return;
    }
    knurl_mesh_corners(sums->mesh, corner >> 2, c);
    const uint32_t k = corner & 3;
    const uint32_t k1 = k == 2 ? 0 : k + 1;
    vec3_sub(c[k1], c[k], next);
    vec3_sub(c[3 - k - k1], c[k], last);
    vec3_cross(next, last, normal);
    const double along = vec3_dot(sums->closest->offset, normal);
    sums->front |= along > 0.0;
    sums->back |= along < 0.0;
    sums->oblique |= along * along < 0.64 * sums->closest->distance2 * vec3_dot(normal, normal);
    if (weigh) {
        const double size = vec3_length(normal);
        const double weight = at_vertex(sums->closest) ? atan2(size, vec3_dot(next, last)) : 1.0;
        sums->weighted += along / size * weight;
        vec3_madd(sums->mean, weight / size, normal, sums->mean);
    }
}

/* Adds all triangles round an edge or a vertex; returns 1 if it is on a boundary. */
static int add_round(side_sums *sums, int weigh) {
    const knurl_mesh *mesh = sums->mesh;
    const uint32_t start = 4 * sums->closest->triangle + feature_corner(sums->closest);
    const uint32_t apex =
        mesh->opposite[3 * (size_t)sums->closest->triangle + opposite_corner(sums->closest)] & KNURL_CORNER_MASK;
    int boundary = 0;
    if (at_vertex(sums->closest) ? (mesh->opposite[corner_slot(start)] & KNURL_NON_MANIFOLD) != 0
                                 : apex == KNURL_NON_MANIFOLD_EDGE) {
        const uint32_t *corners;
        const uint32_t count = corners_at(mesh, sums->closest, &corners);
        for (uint32_t i = 0; i < count; i++) {
            if (shares_feature(mesh, corners[i], sums->closest)) {
                add_triangle(sums, corners[i], weigh);
                boundary |=
                    at_vertex(sums->closest) &&
                    ((mesh->opposite[corner_slot(corner_next(corners[i]))] & KNURL_CORNER_MASK) == KNURL_BOUNDARY ||
                     (mesh->opposite[corner_slot(corner_last(corners[i]))] & KNURL_CORNER_MASK) == KNURL_BOUNDARY);
            }
        }
        return boundary;
    }
    add_triangle(sums, start, weigh);
    if (!at_vertex(sums->closest)) {
        if (apex != KNURL_BOUNDARY) {
            add_triangle(sums, apex, weigh);
        }
        return apex == KNURL_BOUNDARY;
    }
    const knurl_swing ways[2] = {{start, corner_next(start)}, {start, corner_last(start)}};
    uint32_t seen = 1;
    for (int way = 0; way < 2; way++) {
        knurl_swing s = ways[way];
        while ((corner_swing(mesh, &s) & 3) != 3) {
            if (s.corner == start || ++seen == MAX_SIDE) {
                return 0;
            }
            add_triangle(sums, s.corner, weigh);
        }
        boundary = 1;
    }
    return boundary;
}

/* 1 if the walk is caught in a sharp concave corner: p is well off (37 degrees) the normal of a face of the corner. In
 * a valley of a curved surface, whose facets meet at small angles, it hardly is. Testing only the point's own face
 * would not do: p moves straight away from a groove's wall. */
static int is_caught(const walk *w, const knurl_closest_point *closest) {
    if (closest->feature == 7 || vec3_dot(closest->offset, closest->cross) * w->side > 0.0) {
        return 0;
    }
    side_sums sums = {w->mesh, closest, w->visits, 0, 0, 0, 0.0, {0.0, 0.0, 0.0}};
    (void)add_round(&sums, 0);
    return sums.oblique;
}

/* 1 if the surface lies between a closest point and p: p has crossed another wall. */
static int is_walled_off(const walk *w, const knurl_closest_point *closest) {
    double from[3];
    uint32_t triangle;
    knurl_offset_towards(closest->point, w->p, from);
    return knurl_mesh_cross(w->mesh, from, w->p, w->side < 0, NULL, w->visits, &triangle) == w->side;
}

/* A walk may be cut short, or end in a corner that p has left behind: at the bottom of a groove the proxy would stay
 * for ever while p moves on below the ridges. It then continues at the nearest point of the mesh, if the surface holds
 * p there from the same side. The far side of a thin wall faces the opposite direction, and another wall has p in front
 * of it or lies between. */
static void jump_to_nearest(const walk *w, knurl_closest_point *closest) {
    knurl_contact nearest;
    knurl_closest_point other;
    double mean[3];
    int boundary;
    if (!knurl_mesh_closest(w->mesh, w->p, sqrt(closest->distance2) * (1.0 - 1e-9), NULL, w->visits, &nearest)) {
        return;
    }
    knurl_closest_on_triangle(w->mesh, nearest.triangle, w->p, &other);
    if (vec3_dot(other.offset, closest->offset) > 0.0 &&
        knurl_mesh_side(w->mesh, &other, w->visits, &boundary, mean) * w->side < 0 && !is_walled_off(w, closest)) {
        *closest = other;
    }
}

/* A walk of many steps may be circling a vertex: moves at once to the triangle whose edge leads most towards p. */
static int step_across_fan(walk *w, const knurl_closest_point *from, uint32_t corner, knurl_closest_point *to) {
    const knurl_swing ways[2] = {{corner, corner_next(corner)}, {corner, corner_last(corner)}};
    double at[3], off[3], most = -HUGE_VAL;
    uint32_t best = corner, seen = 1;
    vertex_of(w->mesh, corner, at);
    vec3_sub(w->p, at, off);
    for (int way = 0; way < 2; way++) {
        knurl_swing s = ways[way];
        uint32_t apex = corner_swing(w->mesh, &s);
        for (; (apex & 3) != 3 && s.corner != corner; apex = corner_swing(w->mesh, &s)) {
            double edge[3];
            if (++seen == MAX_FAN || !knurl_visits_take(w->visits, 1)) {
                return 0;
            }
            vertex_of(w->mesh, apex, edge);
            vec3_sub(edge, at, edge);
            const double along = vec3_dot(edge, off) / vec3_length(edge);
            best = along > most ? s.corner : best;
            most = along > most ? along : most;
        }
        if (s.corner == corner) {
            break;
        }
    }
    if (seen < FAN_MIN || !knurl_visits_take(w->visits, KNURL_VISITS_CLOSEST)) {
        return 0;
    }
    knurl_closest_on_triangle(w->mesh, best >> 2, w->p, to);
    return is_closer(to, from);
}

/* The same round each corner of the feature. */
static int step_across_fans(walk *w, const knurl_closest_point *from, knurl_closest_point *to) {
    for (unsigned k = 0; k < 3; k++) {
        if ((from->feature >> k & 1) && step_across_fan(w, from, 4 * from->triangle + k, to)) {
            return 1;
        }
    }
    return 0;
}

int knurl_mesh_walk(const knurl_mesh *mesh, const double p[3], int32_t side, knurl_visits *visits,
                    knurl_closest_point *closest) {
    knurl_closest_point points[2];
    const knurl_closest_point *here = closest;
    walk w = {mesh, p, visits, side, 0};
    int steps = 0;
    while (steps < MAX_STEPS && ((steps == FAN_STEPS && step_across_fans(&w, here, &points[steps & 1])) ||
                                 step(&w, here, &points[steps & 1]))) {
        here = &points[steps++ & 1];
        if (!knurl_visits_take(visits, 1)) {
            w.capped = 1;
            break;
        }
    }
    if (here != closest) {
        *closest = *here;
    }
    const int jumps = w.capped || steps == MAX_STEPS || is_caught(&w, closest);
    if (jumps) {
        jump_to_nearest(&w, closest);
    }
    return jumps;
}

/* If the triangles round the feature disagree, the angle-weighted normal decides: its dot product with the offset has
 * the right sign at any closest point of the mesh (Baerentzen and Aanaes 2005); that of a single face has not. */
int knurl_mesh_side(const knurl_mesh *mesh, const knurl_closest_point *closest, knurl_visits *visits, int *boundary,
                    double mean[3]) {
    mean[0] = mean[1] = mean[2] = 0.0;
    if (closest->feature == 7) {
        const double along = vec3_dot(closest->offset, closest->cross);
        *boundary = 0;
        return (along > 0.0) - (along < 0.0);
    }
    side_sums sums = {mesh, closest, visits, 0, 0, 0, 0.0, {0.0, 0.0, 0.0}};
    *boundary = add_round(&sums, 0);
    if (sums.front && sums.back) {
        (void)add_round(&sums, 1);
        vec3_copy(sums.mean, mean);
        (void)vec3_normalise(mean);
        return sums.weighted < 0.0 ? -1 : 1;
    }
    if (!sums.front && !sums.back) { /* no visits left: use the point's own face */
        const double along = vec3_dot(closest->offset, closest->cross);
        return (along > 0.0) - (along < 0.0);
    }
    return sums.front - sums.back;
}

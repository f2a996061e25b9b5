/* Contact with smooth meshes. The felt point is the one whose interpolated normal goes through the HIP. Position and
 * normal are continuous over the edges of patches, so the force is, too. SPDX-License-Identifier: MIT */
#include "contact/mesh_feel.h"

#include "contact/mesh_normals.h"
#include "contact/patch.h"

/* Steps towards the felt point: two on a stroke over a sphere of 1,280 triangles, where the first is 0.1 mm long. */
#define STEPS 6

/* m: the search for the felt point ends this close to it. At a radius of curvature of 5 mm the direction is then off by
 * 0.01 degrees. */
#define ARRIVED 1e-6

/* Slope of the line to the HIP, against the normal at a hard edge, up to which the HIP is held from the edge, as in a
 * groove: 76 degrees. */
#define GROOVE_SLOPE 4.0

/* The contact's path over the surface. */
typedef struct path {
    const knurl_mesh *mesh;
    knurl_patch patch;
    knurl_patch_point at;
    double weights[3];
    int hard; /* the corner opposite the hard edge that the point is on, or -1 */
    int rim;  /* 1: that edge is a boundary, or one that meets it here */
} path;

static void load(const knurl_mesh *mesh, uint32_t triangle, knurl_patch *patch) {
    double corners[3][3], normals[3][3];
    knurl_mesh_corners(mesh, triangle, corners);
    knurl_mesh_normals(mesh, triangle, (const double (*)[3])corners, normals);
    knurl_patch_set((const double (*)[3])corners, (const double (*)[3])normals, patch);
    patch->triangle = triangle;
}

/* Continues in the triangle beyond the edge opposite corner k. Returns 0 if the edge is hard. */
static int cross_edge(path *w, uint32_t k) {
    const uint32_t beyond = w->mesh->opposite[3 * (size_t)w->patch.triangle + k];
    const uint32_t apex = beyond & KNURL_CORNER_MASK;
    const uint32_t next = (k + 1) % 3, last = (k + 2) % 3;
    knurl_patch other;
    w->rim = (w->rim && w->hard >= 0) || apex == KNURL_BOUNDARY; /* in a corner of two hard edges: either */
    if ((apex & 3) == 3 || (beyond & KNURL_FLIPPED)) {
        return 0;
    }
    load(w->mesh, apex >> 2, &other);
    const uint32_t own = apex & 3, own_next = (own + 1) % 3, own_last = (own + 2) % 3;
    if (vec3_dot(w->patch.normals[next], other.normals[own_last]) < KNURL_SOFT_COSINE ||
        vec3_dot(w->patch.normals[last], other.normals[own_next]) < KNURL_SOFT_COSINE) {
        return 0;
    }
    const double weights[2] = {w->weights[next], w->weights[last]};
    w->patch = other;
    w->weights[own] = 0.0;
    w->weights[own_last] = weights[0];
    w->weights[own_next] = weights[1];
    return 1;
}

/* Changes of the weights that bring the point below the HIP, if the surface continued with this curvature. Returns 0 if
 * they are undefined. */
static int find_step(const path *w, double step[3]) {
    const knurl_patch_point *at = &w->at;
    double across[3];
    vec3_cross(at->tangents[0], at->tangents[1], across);
    const double area = vec3_dot(across, at->normal);
    vec3_cross(at->beside, at->tangents[1], across);
    step[1] = vec3_dot(across, at->normal) / area;
    vec3_cross(at->tangents[0], at->beside, across);
    step[2] = vec3_dot(across, at->normal) / area;
    step[0] = -step[1] - step[2];
    return area > 0.0 && knurl_is_finite(step[0]);
}

/* The same along a hard edge; 0 if the point has arrived. */
static int find_step_along(const path *w, double step[3]) {
    const int next = (w->hard + 1) % 3, last = (w->hard + 2) % 3;
    const double none[3] = {0.0, 0.0, 0.0};
    double edge[3];
    vec3_sub(next == 0 ? none : w->at.tangents[next - 1], last == 0 ? none : w->at.tangents[last - 1], edge);
    const double length2 = vec3_dot(edge, edge);
    const double along = vec3_dot(edge, w->at.beside);
    step[w->hard] = 0.0;
    step[next] = along / length2;
    step[last] = -step[next];
    return along * along > ARRIVED * ARRIVED * length2;
}

/* One step, at most to the edge of the triangle. Returns 0 at its end. */
static int take_step(path *w) {
    double step[3], share = 1.0;
    int over = -1;
    if (!find_step(w, step)) {
        return 0;
    }
    if (w->hard >= 0 && step[w->hard] < 0.0) {
        if (!find_step_along(w, step)) {
            return 0;
        }
    } else {
        w->hard = -1;
    }
    for (int i = 0; i < 3; i++) {
        if (i != w->hard && w->weights[i] + step[i] < 0.0 && w->weights[i] < -step[i] * share) {
            share = w->weights[i] / -step[i];
            over = i;
        }
    }
    for (int i = 0; i < 3; i++) {
        w->weights[i] = i == over ? 0.0 : knurl_max(0.0, w->weights[i] + share * step[i]);
    }
    if (over >= 0 && !cross_edge(w, (uint32_t)over)) {
        if (w->hard >= 0) {
            return 0; /* in a corner of two hard edges */
        }
        w->hard = over;
    } else if (over >= 0) {
        w->hard = -1;
    }
    return 1;
}

/* At a hard edge the HIP is held from the edge, in its direction: a groove's proxy. Beyond a boundary it is not. */
static void hold_from_edge(const path *w, int32_t side, double normal[3], double *z) {
    const double beside = vec3_length(w->at.beside);
    vec3_scale(side, w->at.normal, normal);
    *z = side * w->at.z;
    if (w->hard >= 0 && !w->rim && *z < 0.0 && beside > ARRIVED) {
        vec3_scale(*z, normal, normal);
        vec3_madd(normal, knurl_min(1.0, GROOVE_SLOPE * -*z / beside), w->at.beside, normal);
        *z = -vec3_length(normal);
        vec3_scale(1.0 / *z, normal, normal);
    }
}

static void set_facet(const path *w, int32_t side, const double normal[3], knurl_facet *f) {
    f->triangle = w->patch.triangle;
    f->side = side;
    f->has_frame = 0;
    vec3_copy(w->at.tangents[0], f->ab);
    vec3_copy(w->at.tangents[1], f->ac);
    vec3_cross(f->ab, f->ac, f->cross);
    f->cross2 = vec3_dot(f->cross, f->cross);
    f->inverse = 1.0 / f->cross2;
    vec3_copy(normal, f->unit);
}

void knurl_mesh_feel(const knurl_mesh *mesh, int32_t side, knurl_contact *c, knurl_facet *facet) {
    const double *weights = c->weights;
    double hip[3], normal[3], z;
    path w;
    if (knurl_mesh_is_flat_at(mesh, c->triangle) && weights[0] > 0.0 && weights[1] > 0.0 && weights[2] > 0.0) {
        return;
    }
    vec3_madd(c->proxy, c->z, c->normal, hip);
    w.mesh = mesh;
    w.hard = -1;
    w.rim = 0;
    vec3_copy(weights, w.weights);
    load(mesh, c->triangle, &w.patch);
    for (int i = 0;; i++) {
        knurl_patch_at(&w.patch, w.weights, hip, &w.at);
        if (i == STEPS || vec3_dot(w.at.beside, w.at.beside) <= ARRIVED * ARRIVED || !take_step(&w)) {
            break;
        }
    }
    hold_from_edge(&w, side, normal, &z);
    if (!knurl_is_finite(vec3_sum(normal) + z)) {
        return;
    }
    c->z = knurl_max(z, c->z - mesh->facts.bulge); /* the surface is nowhere farther from its triangles */
    vec3_copy(w.at.point, c->proxy);
    vec3_copy(normal, c->normal);
    vec3_copy(w.weights, c->weights);
    c->triangle = w.patch.triangle;
    set_facet(&w, side, normal, facet);
    c->facet = facet;
}

int knurl_mesh_continues(const knurl_mesh *mesh, uint32_t triangle, uint32_t other) {
    knurl_patch a, b;
    load(mesh, triangle, &a);
    load(mesh, other, &b);
    for (int i = 0; i < 9; i++) {
        const double *p = a.corners[i / 3], *q = b.corners[i % 3];
        if (p[0] == q[0] && p[1] == q[1] && p[2] == q[2] &&
            vec3_dot(a.normals[i / 3], b.normals[i % 3]) >= KNURL_SOFT_COSINE) {
            return 1;
        }
    }
    return triangle == other;
}

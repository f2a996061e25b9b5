/* Surface coordinates on a mesh, from an axis, from tangents and uvs, or projected.
 * SPDX-License-Identifier: MIT */
#include "contact/mesh_frame.h"

#include "base/base.h"
#include "base/vec3.h"
#include "contact/facet.h"

#include <string.h>

/* Edges of a triangle, and the changes of u and v along them. */
typedef struct uv_edges {
    double edge1[3], edge2[3];
    double u0, v0;         /* at the first corner */
    double u1, v1, u2, v2; /* differences at the others */
    double det;
} uv_edges;

static const uint32_t *attributes_of(const knurl_mesh *mesh, uint32_t triangle) {
    return &(mesh->attributes ? mesh->attributes : mesh->triangles)[3 * (size_t)triangle];
}

/* The same of projected positions. */
static int find_projected(const double corners[3][3], uv_edges *e) {
    double uv[3][2];
    const int side = knurl_projection_side_of(corners);
    for (int k = 0; k < 3; k++) {
        knurl_projection_place(side, corners[k], uv[k]);
    }
    e->u0 = uv[0][0];
    e->v0 = uv[0][1];
    e->u1 = uv[1][0] - e->u0;
    e->v1 = uv[1][1] - e->v0;
    e->u2 = uv[2][0] - e->u0;
    e->v2 = uv[2][1] - e->v0;
    e->det = e->u1 * e->v2 - e->u2 * e->v1;
    return 1; /* at least 1/sqrt(3) of the triangle's area */
}

/* Fills in all but the edges, for a mesh with uvs. 0 if the uvs have no area. */
static int find_uvs(const knurl_mesh *mesh, uint32_t triangle, uv_edges *e) {
    if (mesh->is_projected) {
        double corners[3][3];
        knurl_mesh_corners(mesh, triangle, corners);
        return find_projected((const double (*)[3])corners, e);
    }
    const uint32_t *at = attributes_of(mesh, triangle);
    const float *uv[3] = {&mesh->uvs[2 * (size_t)at[0]], &mesh->uvs[2 * (size_t)at[1]], &mesh->uvs[2 * (size_t)at[2]]};
    e->u0 = (double)uv[0][0];
    e->v0 = (double)uv[0][1];
    e->u1 = (double)uv[1][0] - e->u0;
    e->v1 = (double)uv[1][1] - e->v0;
    e->u2 = (double)uv[2][0] - e->u0;
    e->v2 = (double)uv[2][1] - e->v0;
    e->det = e->u1 * e->v2 - e->u2 * e->v1;
    return knurl_uvs_have_area(e->u1, e->v1, e->u2, e->v2);
}

/* 0 if the mesh has no uvs, or the uvs have no area. */
static int find_uv_edges(const knurl_mesh *mesh, uint32_t triangle, uv_edges *e) {
    double corners[3][3];
    if (!mesh->uvs && !mesh->is_projected) {
        return 0;
    }
    knurl_mesh_corners(mesh, triangle, corners);
    vec3_sub(corners[1], corners[0], e->edge1);
    vec3_sub(corners[2], corners[0], e->edge2);
    return mesh->is_projected ? find_projected((const double (*)[3])corners, e) : find_uvs(mesh, triangle, e);
}

int knurl_mesh_uv_frame(const knurl_mesh *mesh, uint32_t triangle, double du[3], double dv[3]) {
    uv_edges e;
    if (!find_uv_edges(mesh, triangle, &e)) {
        return 0;
    }
    for (int axis = 0; axis < 3; axis++) {
        du[axis] = (e.v2 * e.edge1[axis] - e.v1 * e.edge2[axis]) / e.det;
        dv[axis] = (e.u1 * e.edge2[axis] - e.u2 * e.edge1[axis]) / e.det;
    }
    return vec3_dot(du, du) > 0.0 && vec3_dot(dv, dv) > 0.0;
}

/* Direction in which u grows, of any length: dP/du without the division. */
static void find_u_direction(const uv_edges *e, double x[3]) {
    const double along = e->det < 0.0 ? -1.0 : 1.0;
    for (int axis = 0; axis < 3; axis++) {
        x[axis] = along * (e->v2 * e->edge1[axis] - e->v1 * e->edge2[axis]);
    }
}

void knurl_mesh_set_axis(knurl_mesh *mesh, const double axis[3]) {
    vec3_copy(axis, mesh->axis);
    mesh->has_axis = 1;
    double area = 0.0;
    double sum = 0.0;
    double *along = mesh->facts.stretch[0];
    double *across = mesh->facts.stretch[1];
    along[0] = 1.0;
    along[2] = 0.0;
    across[0] = across[1] = across[2] = 1.0; /* in metres, for faces in any direction */
    for (uint32_t i = 0; i < mesh->triangle_count; i++) {
        knurl_triangle t;
        double tangent[3];
        knurl_mesh_triangle(mesh, i, &t);
        vec3_copy(mesh->axis, tangent);
        vec3_make_tangent(t.normal, tangent);
        const double length = vec3_length(tangent);
        along[0] = fmin(along[0], length);
        along[2] = fmax(along[2], length);
        area += t.area_twice;
        sum += t.area_twice * length;
    }
    along[1] = sum / area;
}

/* A coordinate's growth per metre along the triangle: in its plane, a displacement w is a edge1 + b edge2, with a = w .
 * (edge2 x across) / cross2 and b = w . (across x edge1) / cross2. c1, c2: its growth along the edges. */
static void find_gradient(const double edge1[3], const double edge2[3], const double across[3], double c1, double c2,
                          double scale, double gradient[3]) {
    double first[3], second[3];
    vec3_cross(edge2, across, first);
    vec3_cross(across, edge1, second);
    vec3_scale(c1, first, gradient);
    vec3_madd(gradient, c2, second, gradient);
    vec3_scale(scale / vec3_dot(across, across), gradient, gradient);
}

static int rates_by_uvs(const knurl_mesh *mesh, const knurl_contact *contact, const double velocity[3],
                        double rates[2]) {
    uv_edges e;
    double across[3], u[3], v[3];
    if (!find_uv_edges(mesh, contact->triangle, &e)) {
        return 0;
    }
    vec3_cross(e.edge1, e.edge2, across);
    const double facing = vec3_dot(across, contact->normal) * e.det;
    find_gradient(e.edge1, e.edge2, across, e.u1, e.u2, mesh->uv_scale[0], u);
    find_gradient(e.edge1, e.edge2, across, e.v1, e.v2, facing < 0.0 ? -mesh->uv_scale[1] : mesh->uv_scale[1], v);
    rates[0] = vec3_dot(u, velocity);
    rates[1] = vec3_dot(v, velocity);
    return 1;
}

/* x from the tangents, else along dP/du; coordinates from the uvs, scaled to mean metres. */
static void frame_by_uvs(const knurl_mesh *mesh, const knurl_contact *contact, double x[3], double coordinates[2]) {
    uv_edges e;
    x[0] = x[1] = x[2] = coordinates[0] = coordinates[1] = 0.0;
    if (find_uv_edges(mesh, contact->triangle, &e)) {
        double across[3];
        const double *w = contact->weights;
        vec3_cross(e.edge1, e.edge2, across); /* det times du x dv */
        /* y = n x x, for either direction of v: glTF's v runs down the image. */
        const double facing = vec3_dot(across, contact->normal) * e.det;
        coordinates[0] = (e.u0 + w[1] * e.u1 + w[2] * e.u2) * mesh->uv_scale[0];
        coordinates[1] = (e.v0 + w[1] * e.v1 + w[2] * e.v2) * (facing < 0.0 ? -mesh->uv_scale[1] : mesh->uv_scale[1]);
        find_u_direction(&e, x);
    }
    if (mesh->tangents) {
        const uint32_t *at = attributes_of(mesh, contact->triangle);
        for (size_t axis = 0; axis < 3; axis++) {
            x[axis] = contact->weights[0] * (double)mesh->tangents[3 * (size_t)at[0] + axis] +
                      contact->weights[1] * (double)mesh->tangents[3 * (size_t)at[1] + axis] +
                      contact->weights[2] * (double)mesh->tangents[3 * (size_t)at[2] + axis];
        }
    }
}

/* x: `along` made tangent to the normal (at an edge not that of a face), unit. y = n x x. */
static void frame_along(const double normal[3], const double along[3], double x[3], double y[3]) {
    vec3_copy(along, x);
    vec3_make_tangent(normal, x);
    const double length2 = vec3_dot(x, x);
    if (!(length2 > 1e-18 * vec3_dot(along, along))) { /* parallel to the normal: any direction will do */
        vec3_any_tangent(normal, x);
    } else {
        vec3_scale(1.0 / sqrt(length2), x, x);
    }
    vec3_cross(normal, x, y);
}

/* m: the coordinate across the axis. On a smooth mesh, whose y turns along the stroke, it is measured along the
 * triangle's y. */
static double across_triangle(const knurl_mesh *mesh, const knurl_contact *contact) {
    knurl_triangle t;
    double x[3], y[3];
    knurl_mesh_triangle(mesh, contact->triangle, &t);
    vec3_scale(vec3_dot(t.normal, contact->normal) < 0.0 ? -1.0 : 1.0, t.normal, t.normal);
    frame_along(t.normal, mesh->axis, x, y);
    return vec3_dot(contact->proxy, y);
}

static void find_frame(const knurl_mesh *mesh, const knurl_contact *contact, double x[3], double y[3],
                       double coordinates[2]) {
    double along[3];
    if (mesh->has_axis) {
        vec3_copy(mesh->axis, along);
    } else {
        frame_by_uvs(mesh, contact, along, coordinates);
    }
    frame_along(contact->normal, along, x, y);
    if (mesh->has_axis) {
        coordinates[0] = vec3_dot(contact->proxy, mesh->axis);
        coordinates[1] = mesh->normals ? across_triangle(mesh, contact) : vec3_dot(contact->proxy, y);
    }
}

/* Caches the frame and the uvs of a facet, with the same numbers as find_frame(). */
static void keep_frame(const knurl_mesh *mesh, knurl_facet *f) {
    uv_edges e;
    vec3_copy(f->ab, e.edge1);
    vec3_copy(f->ac, e.edge2);
    double x[3] = {0.0, 0.0, 0.0};
    f->has_uvs = (mesh->uvs || mesh->is_projected) && find_uvs(mesh, f->triangle, &e);
    if (f->has_uvs) {
        find_u_direction(&e, x);
        f->u0 = e.u0;
        f->v0 = e.v0;
        f->u1 = e.u1;
        f->v1 = e.v1;
        f->u2 = e.u2;
        f->v2 = e.v2;
        f->scale[0] = mesh->uv_scale[0];
        f->scale[1] = vec3_dot(f->cross, f->unit) * e.det < 0.0 ? -mesh->uv_scale[1] : mesh->uv_scale[1];
    }
    frame_along(f->unit, x, f->x, f->y);
    f->has_frame = 1;
    f->has_gradients = 0;
}

void knurl_mesh_carry(const knurl_mesh *mesh, const knurl_contact *contact, int begins, knurl_projection_carry *carry,
                      double coordinates[2]) {
    if (begins || contact->triangle != carry->triangle) {
        double before[2], corners[3][3], point[3] = {0.0, 0.0, 0.0};
        knurl_mesh_corners(mesh, contact->triangle, corners);
        const int side = knurl_projection_side_of((const double (*)[3])corners);
        if (begins) {
            carry->by[0] = carry->by[1] = 0.0;
        } else if (side != carry->side) {
            for (int k = 0; k < 3; k++) { /* a smooth mesh's proxy may be off the triangle */
                vec3_madd(point, contact->weights[k], corners[k], point);
            }
            knurl_projection_place(carry->side, point, before);
            carry->by[0] += before[0] - coordinates[0];
            carry->by[1] += before[1] - coordinates[1];
        }
        carry->side = side;
        carry->triangle = contact->triangle;
    }
    coordinates[0] += carry->by[0];
    coordinates[1] += carry->by[1];
}

void knurl_mesh_find_frame(const knurl_mesh *mesh, const knurl_contact *contact, double x[3], double y[3],
                           double coordinates[2]) {
    if (contact->facet && !mesh->tangents && !mesh->has_axis) {
        keep_frame(mesh, contact->facet);
        knurl_mesh_frame(mesh, contact, x, y, coordinates);
    } else {
        find_frame(mesh, contact, x, y, coordinates);
    }
}

/* rates_by_uvs() on a cached facet. */
static int rates_on_facet(knurl_facet *f, const double velocity[3], double rates[2]) {
    if (!f->has_uvs) {
        return 0;
    }
    if (KNURL_UNLIKELY(!f->has_gradients)) {
        find_gradient(f->ab, f->ac, f->cross, f->u1, f->u2, f->scale[0], f->gradients[0]);
        find_gradient(f->ab, f->ac, f->cross, f->v1, f->v2, f->scale[1], f->gradients[1]);
        f->has_gradients = 1;
    }
    rates[0] = vec3_dot(f->gradients[0], velocity);
    rates[1] = vec3_dot(f->gradients[1], velocity);
    return 1;
}

int knurl_mesh_find_rates(const knurl_mesh *mesh, const knurl_contact *contact, const double velocity[3],
                          double rates[2]) {
    double x[3], y[3], coordinates[2];
    if (mesh->tangents && mesh->normals && contact->facet && !mesh->has_axis) {
        knurl_facet curved = *contact->facet; /* a copy: with tangents, a kept frame would be wrong */
        keep_frame(mesh, &curved);
        return rates_on_facet(&curved, velocity, rates);
    }
    if (!mesh->has_axis) {
        return contact->facet && contact->facet->has_frame ? rates_on_facet(contact->facet, velocity, rates)
                                                           : rates_by_uvs(mesh, contact, velocity, rates);
    }
    knurl_mesh_frame(mesh, contact, x, y, coordinates);
    rates[0] = vec3_dot(velocity, mesh->axis);
    rates[1] = vec3_dot(velocity, y);
    return 1;
}

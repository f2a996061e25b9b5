/* Surface coordinates on a mesh, from an axis or from tangents and uvs.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_MESH_FRAME_H
#define KNURL_SRC_MESH_FRAME_H

#include "contact/facet.h"
#include "contact/mesh.h"
#include "contact/projection.h"

/* 1 if uvs, given by their differences along two edges, have an area. They are floats: a smaller determinant is
 * rounding. */
static inline int knurl_uvs_have_area(double u1, double v1, double u2, double v2) {
    const double largest = fabs(u1) + fabs(u2) + fabs(v1) + fabs(v2);
    return fabs(u1 * v2 - u2 * v1) > 1e-9 * largest * largest;
}

/* dP/du and dP/dv of a triangle; 0 if it has no uvs, or the uvs have no area. */
int knurl_mesh_uv_frame(const knurl_mesh *mesh, uint32_t triangle, double du[3], double dv[3]);

/* After knurl_mesh_create(): makes x run along an axis (unit), and sets stretch to its tangential length. */
void knurl_mesh_set_axis(knurl_mesh *mesh, const double axis[3]);

/* Slow path of knurl_mesh_frame(), if no frame is cached. */
void knurl_mesh_find_frame(const knurl_mesh *mesh, const knurl_contact *contact, double x[3], double y[3],
                           double coordinates[2]) KNURL_NONBLOCKING;

/* Tangent frame at a contact (unit, tangent to the contact's normal, y = n x x) from the axis, else from tangents or
 * uvs, and the position on the grating (m; 0 without an axis and uvs). Allowed in a tick. */
static inline void knurl_mesh_frame(const knurl_mesh *mesh, const knurl_contact *contact, double x[3], double y[3],
                                    double coordinates[2]) {
    const knurl_facet *f = contact->facet;
    if (f && f->has_frame) {
        const double *w = contact->weights;
        vec3_copy(f->x, x);
        vec3_copy(f->y, y);
        coordinates[0] = f->has_uvs ? (f->u0 + w[1] * f->u1 + w[2] * f->u2) * f->scale[0] : 0.0;
        coordinates[1] = f->has_uvs ? (f->v0 + w[1] * f->v1 + w[2] * f->v2) * f->scale[1] : 0.0;
    } else {
        double found[3][3]; /* local, so that the caller's can stay in registers */
        knurl_mesh_find_frame(mesh, contact, found[0], found[1], found[2]);
        vec3_copy(found[0], x);
        vec3_copy(found[1], y);
        coordinates[0] = found[2][0];
        coordinates[1] = found[2][1];
    }
}

/* Slow path of knurl_mesh_rates(), if no gradients are cached. */
int knurl_mesh_find_rates(const knurl_mesh *mesh, const knurl_contact *contact, const double velocity[3],
                          double rates[2]) KNURL_NONBLOCKING;

/* Rates of change of those coordinates (m/s) at a velocity of the HIP (m/s). Returns 0 if there is no axis and the uvs
 * have no area: do not use the outputs then. Allowed in a tick. */
static inline int knurl_mesh_rates(const knurl_mesh *mesh, const knurl_contact *contact, const double velocity[3],
                                   double rates[2]) {
    const knurl_facet *f = contact->facet;
    if (f && f->has_frame && f->has_gradients) {
        rates[0] = vec3_dot(f->gradients[0], velocity);
        rates[1] = vec3_dot(f->gradients[1], velocity);
        return 1;
    }
    const double moving[3] = {velocity[0], velocity[1], velocity[2]}; /* copies, see force_law.h */
    double found[2] = {0.0, 0.0};
    const int has_coordinates = knurl_mesh_find_rates(mesh, contact, moving, found);
    rates[0] = found[0];
    rates[1] = found[1];
    return has_coordinates;
}

/* Makes projected coordinates go on across an edge at which the projection changes. There they would jump, and half
 * cycles would be counted that the HIP has not crossed. begins: 1: the contact's first tick. Allowed in a tick. */
void knurl_mesh_carry(const knurl_mesh *mesh, const knurl_contact *contact, int begins, knurl_projection_carry *carry,
                      double coordinates[2]) KNURL_NONBLOCKING;

#endif

/* Surface coordinates on a mesh: by an axis, or by tangents and uvs, and how far the uvs stretch.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_MESH_FRAME_H
#define KNURL_SRC_MESH_FRAME_H

#include "contact/facet.h"
#include "contact/mesh.h"

/* Part of knurl_mesh_create(): uv_scale and stretch. */
void knurl_mesh_measure_uvs(knurl_mesh *mesh);

/* Part of the same: x runs along this axis (unit), and stretch is by how much of it is tangent. */
void knurl_mesh_set_axis(knurl_mesh *mesh, const double axis[3]);

/* The first on a triangle: called by knurl_mesh_frame(). */
void knurl_mesh_find_frame(const knurl_mesh *mesh, const knurl_contact *contact, double x[3], double y[3],
                           double coordinates[2]) KNURL_NONBLOCKING;

/* The surface's tangent frame at a contact (unit, tangent to the contact's normal, y = n x x), by the axis, else by
 * tangents or uvs, and where on the grating it is (m; 0 without an axis and uvs). Allowed in a tick. */
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
        double found[3][3]; /* copies, so that the caller's can stay in registers */
        knurl_mesh_find_frame(mesh, contact, found[0], found[1], found[2]);
        vec3_copy(found[0], x);
        vec3_copy(found[1], y);
        coordinates[0] = found[2][0];
        coordinates[1] = found[2][1];
    }
}

/* How fast those coordinates change (m/s) where the HIP moves at `velocity` (m/s), and by how much at most in a metre
 * along the surface. 0 and untouched without an axis where the uvs have no area. Allowed in a tick. */
int knurl_mesh_rates(const knurl_mesh *mesh, const knurl_contact *contact, const double velocity[3], double rates[2],
                     double *steepest) KNURL_NONBLOCKING;

#endif

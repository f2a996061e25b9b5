/* Surface coordinates on a mesh: by an axis, or by tangents and uvs, and how far the uvs stretch.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_MESH_FRAME_H
#define KNURL_SRC_MESH_FRAME_H

#include "contact/contact.h"
#include "contact/mesh.h"

/* Part of knurl_mesh_create(): uv_scale and stretch. */
void knurl_mesh_measure_uvs(knurl_mesh *mesh);

/* Part of the same: x runs along this axis (unit), and stretch is by how much of it is tangent. */
void knurl_mesh_set_axis(knurl_mesh *mesh, const double axis[3]);

/* The surface's tangent frame at a contact (unit, tangent to the contact's normal, y = n x x), by the axis, else by
 * tangents or uvs, and where on the grating it is (m; 0 without an axis and uvs). Allowed in a tick. */
void knurl_mesh_frame(const knurl_mesh *mesh, const knurl_contact *contact, double x[3], double y[3],
                      double coordinates[2]) KNURL_NONBLOCKING;

/* How fast those coordinates change (m/s) where the HIP moves at `velocity` (m/s), and by how much at most in a metre
 * along the surface. 0 and untouched without an axis where the uvs have no area. Allowed in a tick. */
int knurl_mesh_rates(const knurl_mesh *mesh, const knurl_contact *contact, const double velocity[3], double rates[2],
                     double *steepest) KNURL_NONBLOCKING;

#endif

/* Casts a segment against a triangle mesh, including edges and seams. Everything here is allowed in a tick.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_MESH_CAST_H
#define KNURL_SRC_MESH_CAST_H

#include "contact/contact.h"
#include "contact/mesh.h"

/* Returns 1 and the first hit of a segment. Every triangle extends beyond its edges by the mesh's seam. */
int knurl_mesh_cast(const knurl_mesh *mesh, const knurl_cast *cast, knurl_cast_hit *hit) KNURL_NONBLOCKING;

/* Sets a contact at a point of the triangle that was hit; the caller sets normal and z. */
void knurl_mesh_rest(const knurl_mesh *mesh, const knurl_cast_hit *hit, const double point[3],
                     knurl_contact_state *state, knurl_contact *contact) KNURL_NONBLOCKING;

#endif

/* Replaces flat meshes by planes with their outline. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_PLANE_FROM_MESH_H
#define KNURL_SRC_PLANE_FROM_MESH_H

#include "contact/plane.h"

#include <knurl/contact.h>

/* A flat mesh as a plane with its true outline. desc: checked by knurl_mesh_check(). axis: unit, the grating's x in the
 * mesh's frame, or null: tangents, else uvs. position, rotation: where the plane's frame stands in the mesh's. *why: a
 * static sentence in either case. Returns KNURL_OK with *plane null where the mesh does not come to a plane.
 * Errors: KNURL_ERROR_MEMORY. */
knurl_result knurl_plane_from_mesh(knurl_heap *heap, const knurl_mesh_desc *desc, const double axis[3],
                                   knurl_plane **plane, double position[3], double rotation[9], const char **why);

#endif

/* Replaces flat meshes by planes with an outline. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_PLANE_FROM_MESH_H
#define KNURL_SRC_PLANE_FROM_MESH_H

#include "contact/plane.h"

#include <knurl/contact.h>

/* Converts a flat mesh to a plane with its outline. desc: checked by knurl_mesh_check(). axis: unit, the grating's x in
 * the mesh's frame; null: tangents, else uvs. position, rotation: the plane's frame in the mesh's. *why: a static
 * sentence, in either case. Returns KNURL_OK and *plane null if the mesh cannot become a plane. Errors:
 * KNURL_ERROR_MEMORY. */
knurl_result knurl_plane_from_mesh(knurl_heap *heap, const knurl_mesh_desc *desc, const double axis[3],
                                   knurl_plane **plane, double position[3], double rotation[9], const char **why);

#endif

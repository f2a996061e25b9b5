/* Builds a mesh from its description. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_MESH_BUILD_H
#define KNURL_SRC_MESH_BUILD_H

#include "contact/mesh.h"

/* Copies and welds a description that passed knurl_mesh_check(), and builds its hierarchy. Errors: KNURL_ERROR_ARGUMENT
 * (no triangle with an area), KNURL_ERROR_MEMORY. */
knurl_result knurl_mesh_create(knurl_heap *heap, const knurl_mesh_desc *desc, knurl_mesh **mesh);

#endif

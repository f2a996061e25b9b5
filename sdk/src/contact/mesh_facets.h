/* How rough a mesh is. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_MESH_FACETS_H
#define KNURL_SRC_MESH_FACETS_H

#include "contact/mesh.h"

/* Counts at the first call, for reports: a build does without. [one thread at a time for each mesh] */
const knurl_mesh_facets *knurl_mesh_get_facets(knurl_mesh *mesh);

#endif

/* Angles at a mesh's edges, for reports. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_MESH_FACETS_H
#define KNURL_SRC_MESH_FACETS_H

#include "contact/mesh.h"

/* Counts and measures the edges; not part of a build, because a million triangles take most of a second. */
void knurl_mesh_count_facets(const knurl_mesh *mesh, knurl_mesh_facets *facets);

#endif

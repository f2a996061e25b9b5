/* How rough a mesh is. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_MESH_FACETS_H
#define KNURL_SRC_MESH_FACETS_H

#include "contact/mesh.h"

/* Counts the edges, for reports: a build does without. A million triangles take most of a second. */
void knurl_mesh_count_facets(const knurl_mesh *mesh, knurl_mesh_facets *facets);

#endif

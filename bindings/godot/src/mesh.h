/* An engine's mesh in Knurl's shape. SPDX-License-Identifier: MIT */
#ifndef KNURL_GODOT_MESH_H
#define KNURL_GODOT_MESH_H

#include "api.h"

#include <knurl/contact.h>

typedef struct mesh_data {
    float *positions; /* 3 a vertex */
    float *tangents;  /* 4 a vertex */
    float *uvs;       /* 2 a vertex */
    uint32_t *indices;
    uint32_t vertex_count;
    uint64_t index_count;
    int has_tangents, has_uvs; /* 1: every surface of the mesh has them */
} mesh_data;

/* Reads all surfaces of triangles, counter-clockwise in front, with the row-major matrix `baked` applied to positions
 * and tangents. 1, or 0 where memory is short. To be ended in either case. */
int mesh_read(GDExtensionObjectPtr mesh, const double baked[9], mesh_data *data);
void mesh_end(mesh_data *data);

/* What knurl_scene_add_surface() wants of it. */
void mesh_describe(const mesh_data *data, knurl_mesh_desc *desc);

#endif

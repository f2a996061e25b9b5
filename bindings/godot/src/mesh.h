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

/* Where a mesh stands in what it is read into: at matrix * position + offset. */
typedef struct mesh_place {
    double matrix[9]; /* row-major */
    double offset[3]; /* m */
} mesh_place;

/* Begins with nothing; to be ended. */
void mesh_begin(mesh_data *data);

/* Adds all surfaces of triangles, counter-clockwise in front. 1, or 0 where memory is short. */
int mesh_add(GDExtensionObjectPtr mesh, const mesh_place *place, mesh_data *data);

/* Adds triangles: corners one after another in a PackedVector3Array. 1, or 0 where memory is short. */
int mesh_add_faces(const void *corners, const mesh_place *place, mesh_data *data);
void mesh_end(mesh_data *data);

/* The description that knurl_scene_add_surface() takes; it points into the data. */
void mesh_describe(const mesh_data *data, knurl_mesh_desc *desc);

#endif

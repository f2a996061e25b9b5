/* An engine's mesh, converted for Knurl. SPDX-License-Identifier: MIT */
#ifndef KNURL_GODOT_MESH_H
#define KNURL_GODOT_MESH_H

#include "api.h"

#include <knurl/contact.h>

typedef struct mesh_data {
    float *positions; /* 3 a vertex */
    float *normals;   /* 3 a vertex */
    float *tangents;  /* 4 a vertex */
    float *uvs;       /* 2 a vertex */
    uint32_t *indices;
    uint32_t vertex_count;
    uint64_t index_count;
    int has_normals, has_tangents, has_uvs; /* 1: every surface of the mesh has them */
} mesh_data;

/* A mesh's pose in the data that it is read into: matrix * position + offset. */
typedef struct mesh_place {
    double matrix[9]; /* row-major */
    double offset[3]; /* m */
} mesh_place;

/* Starts empty; end it with mesh_end(). */
void mesh_begin(mesh_data *data);

/* Adds all surfaces of triangles, counter-clockwise in front. Returns 1, or 0 if memory runs out. */
int mesh_add(GDExtensionObjectPtr mesh, const mesh_place *place, mesh_data *data);

/* Adds triangles: corners one after another in a PackedVector3Array. Returns 1, or 0 if memory runs out. */
int mesh_add_faces(const void *corners, const mesh_place *place, mesh_data *data);
void mesh_end(mesh_data *data);

/* The description that knurl_scene_add_surface() takes; it points into the data. */
void mesh_describe(const mesh_data *data, knurl_mesh_desc *desc);

#endif

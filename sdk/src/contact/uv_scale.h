/* The scale of a mesh's uvs, in metres, and how evenly they are laid out. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_UV_SCALE_H
#define KNURL_SRC_UV_SCALE_H

#include "contact/mesh.h"

/* 1 if at least half of the area has uvs with an area. A palette's have none: each triangle has one colour. */
int knurl_uvs_are_usable(const knurl_mesh_desc *desc);

/* Part of knurl_mesh_create(): sets uv_scale, stretch and uneven. Errors: KNURL_ERROR_MEMORY. */
knurl_result knurl_mesh_measure_uvs(knurl_heap *heap, knurl_mesh *mesh);

/* After knurl_mesh_create() without uvs and tangents: makes positions the coordinates. Errors: KNURL_ERROR_MEMORY. */
knurl_result knurl_mesh_set_projection(knurl_heap *heap, knurl_mesh *mesh);

#endif

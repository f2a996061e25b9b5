/* The triangles of a node. SPDX-License-Identifier: MIT */
#ifndef KNURL_GODOT_GEOMETRY_H
#define KNURL_GODOT_GEOMETRY_H

#include "mesh.h"

/* 1: a node that makes its meshes itself, at the end of a frame, and tells nobody. */
int geometry_is_made_later(GDExtensionObjectPtr node);

/* Why a node's shape cannot be felt, a sentence in a caller's buffer; "" where it can. node: or null. */
void geometry_refuse(GDExtensionObjectPtr node, char *text, size_t size);

/* Reads all triangles of a node, with the row-major matrix `baked` applied; to be ended in either case. 1, or 0 where
 * memory is short. What cannot be felt has none. */
int geometry_read(GDExtensionObjectPtr node, const double baked[9], mesh_data *data);

/* A MeshInstance3D's mesh in a Variant that holds it: to be ended. Null where there is none, or another node. */
GDExtensionObjectPtr geometry_mesh(GDExtensionObjectPtr node, gd_variant *held);

#endif

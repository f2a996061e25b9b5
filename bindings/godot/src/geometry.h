/* The triangles of a node. SPDX-License-Identifier: MIT */
#ifndef KNURL_GODOT_GEOMETRY_H
#define KNURL_GODOT_GEOMETRY_H

#include "mesh.h"

/* 1: a node that builds its meshes itself, at the end of a frame, without a signal. */
int geometry_is_made_later(GDExtensionObjectPtr node);

/* Why a node's shape cannot be felt: a sentence in a caller's buffer, "" if it can. node may be null. */
void geometry_refuse(GDExtensionObjectPtr node, char *text, size_t size);

/* Reads all triangles of a node, with the row-major matrix `baked` applied; `data` must be ended in either case.
 * Returns 1, or 0 if memory runs out. Nodes that cannot be felt have no triangles. */
int geometry_read(GDExtensionObjectPtr node, const double baked[9], mesh_data *data);

/* A MeshInstance3D's mesh in a Variant that holds it: to be destroyed. Null if it has no mesh, or the node is of
 * another class. */
GDExtensionObjectPtr geometry_mesh(GDExtensionObjectPtr node, gd_variant *held);

#endif

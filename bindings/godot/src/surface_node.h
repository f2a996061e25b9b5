/* A surface as its nodes have it: its parent, where it stands, its triangles and its grating.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_GODOT_SURFACE_NODE_H
#define KNURL_GODOT_SURFACE_NODE_H

#include "world.h"

/* The node whose triangles are felt. */
GDExtensionObjectPtr surface_parent(const surface *s);

/* A Node3D's transform in the world, as the engine has it. */
void node_transform(GDExtensionObjectPtr node, gd_transform *transform);

/* The same as a pose: 1, or 0 where it is scaled to nothing. */
int transform_pose(const gd_transform *transform, knurl_session_pose *pose);

/* Both at once. */
int node_pose(GDExtensionObjectPtr node, knurl_session_pose *pose);

/* 1: surface and device have a layer in common. */
int surface_is_on_layer_of(const surface *s, const device *d);

/* Puts a surface into a scene, in the place of *id, or where that is 0 beside what is there: then it gets the id. It
 * has a grating and a parent that can be felt. KNURL_ERROR_STATE: there are no triangles yet. */
knurl_result surface_put(surface *s, knurl_scene *scene, const knurl_session_pose *at, knurl_surface_id *id);

#endif

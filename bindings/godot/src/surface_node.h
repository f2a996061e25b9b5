/* The data that a surface takes from its nodes: its parent, pose, triangles and grating.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_GODOT_SURFACE_NODE_H
#define KNURL_GODOT_SURFACE_NODE_H

#include "world.h"

/* The node whose triangles are felt. */
GDExtensionObjectPtr surface_parent(const surface *s);

/* A Node3D's global transform, in the engine's type. */
void node_transform(GDExtensionObjectPtr node, gd_transform *transform);

/* The same as a pose: 1, or 0 if its scale is zero. */
int transform_pose(const gd_transform *transform, knurl_session_pose *pose);

/* Both at once. */
int node_pose(GDExtensionObjectPtr node, knurl_session_pose *pose);

/* 1: surface and device have a layer in common. */
int surface_is_on_layer_of(const surface *s, const device *d);

/* Puts a surface into a scene, replacing *id, or as a new surface, whose id *id receives, if that is 0. It must have a
 * grating and a parent that can be felt. shape_of: a surface of the scene with the same shape, or 0: it is read from
 * the parent. KNURL_ERROR_STATE: there are no triangles yet. */
knurl_result surface_put(surface *s, knurl_scene *scene, const knurl_session_pose *at, knurl_surface_id shape_of,
                         knurl_surface_id *id);

#endif

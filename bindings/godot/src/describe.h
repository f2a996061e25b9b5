/* What a surface is, as its nodes say: whose it is, where it stands, its triangles and its grating.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_GODOT_DESCRIBE_H
#define KNURL_GODOT_DESCRIBE_H

#include "world.h"

/* The node whose triangles are felt. */
GDExtensionObjectPtr describe_parent(const surface *s);

/* Where a Node3D stands, in the world: 1, or 0 where it is scaled to nothing. */
int describe_pose(GDExtensionObjectPtr node, knurl_session_pose *pose);

/* Puts a surface into a scene, in the place of *id, or where that is 0 beside what is there: then it gets the id. It
 * has a grating and a parent that can be felt. */
knurl_result describe_surface(surface *s, knurl_scene *scene, const knurl_session_pose *at, knurl_surface_id *id);

#endif

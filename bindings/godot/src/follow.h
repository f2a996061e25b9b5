/* Surfaces into a device's scene, along with their nodes, and out. Errors are pushed.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_GODOT_FOLLOW_H
#define KNURL_GODOT_FOLLOW_H

#include "world.h"

/* As it is now, in the place of what the device's scene has of it; out, where it cannot be felt. */
void follow_put(device *d, surface *s);
void follow_remove(device *d, surface *s);

/* Puts it into a scene, in the place of *id, or where that is 0 beside what is there: then it gets the id. It has a
 * grating and a parent that can be felt. */
knurl_result follow_describe(surface *s, knurl_scene *scene, const knurl_session_pose *at, knurl_surface_id *id);
void follow_all(device *d);

/* After some were put: tells how many failed beyond those that were told of one by one. */
void follow_count_failures(device *d);

/* 1: it is in the scene of a running device. */
int follow_is_felt(const surface *s);

GDExtensionObjectPtr follow_parent(const surface *s);

/* Where a Node3D stands, in the world: 1, or 0 where it is scaled to nothing. */
int follow_pose(GDExtensionObjectPtr node, knurl_session_pose *pose);

#endif

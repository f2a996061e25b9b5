/* Surfaces into a device's scene, along with their nodes, and out. Errors are pushed.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_GODOT_FOLLOW_H
#define KNURL_GODOT_FOLLOW_H

#include "world.h"

void follow_add(device *d, surface *s);
void follow_remove(device *d, surface *s);
void follow_all(device *d);

/* Where a Node3D stands, in the world: 1, or 0 where it is scaled to nothing. */
int follow_pose(GDExtensionObjectPtr node, knurl_session_pose *pose);

/* Why a surface cannot be felt, a line each, in a caller's buffer; "" where it can. */
void follow_explain(const surface *s, char *text, size_t size);

#endif

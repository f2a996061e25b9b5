/* Changes of meshes. SPDX-License-Identifier: MIT */
#ifndef KNURL_GODOT_WATCH_H
#define KNURL_GODOT_WATCH_H

#include "world.h"

/* Starts or stops calling the surface's update_mesh() when its parent gets another mesh or the mesh changes. May be
 * repeated. */
void watch_mesh(surface *s);
void unwatch_mesh(surface *s);

#endif

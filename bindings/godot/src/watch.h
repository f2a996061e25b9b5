/* Changes of meshes. SPDX-License-Identifier: MIT */
#ifndef KNURL_GODOT_WATCH_H
#define KNURL_GODOT_WATCH_H

#include "world.h"

/* From now on the surface's update_mesh() is called when its parent gets another mesh or the mesh changes, or no more.
 * Twice is fine. */
void watch_mesh(surface *s);
void unwatch_mesh(surface *s);

#endif

/* A device's view of a surface, for the editor: warnings and the scale of ridges. SPDX-License-Identifier: MIT */
#ifndef KNURL_GODOT_PREVIEW_H
#define KNURL_GODOT_PREVIEW_H

#include "world.h"

/* Lines in a caller's buffer, "" if there are no problems. Cached until something changes. */
void preview_surface(surface *s, const knurl_session_pose *at, char *text, size_t size);

/* Metres for each unit of u and v of the mesh, at the node's scale: 0 if its ridges do not follow uvs, or it cannot be
 * felt. */
void preview_uv_scale(surface *s, const knurl_session_pose *at, double scale[2]);

#endif

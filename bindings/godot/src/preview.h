/* Warnings that a device would give in a game, for the editor. SPDX-License-Identifier: MIT */
#ifndef KNURL_GODOT_PREVIEW_H
#define KNURL_GODOT_PREVIEW_H

#include "world.h"

/* Lines in a caller's buffer, "" if there are no problems. Cached until something changes. */
void preview_surface(surface *s, const knurl_session_pose *at, char *text, size_t size);

#endif

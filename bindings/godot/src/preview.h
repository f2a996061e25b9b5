/* Warnings that a device would give in a game, for the editor. SPDX-License-Identifier: MIT */
#ifndef KNURL_GODOT_PREVIEW_H
#define KNURL_GODOT_PREVIEW_H

#include "world.h"

/* Lines in a caller's buffer, "" where all is well; the same as it was told last, where nothing has changed since. */
void preview_surface(surface *s, const knurl_session_pose *at, char *text, size_t size);

#endif

/* Why surfaces cannot be felt, or not as asked for. SPDX-License-Identifier: MIT */
#ifndef KNURL_GODOT_EXPLAIN_H
#define KNURL_GODOT_EXPLAIN_H

#include "world.h"

/* A line each, in a caller's buffer; "" where all is well. In the editor: what the devices that stand in the tree would
 * say, by their presets; in a game: what those that run do say, or only `only`, unless it is null. */
void explain_surface(surface *s, const device *only, char *text, size_t size);

/* The same of a device. */
void explain_device(const device *d, char *text, size_t size);

/* When a device starts: warns of everything that it does not play as asked for; only of the first few, and of each once
 * per process, because games start their devices in scene after scene. Most surfaces of a game are out of its reach, so
 * it warns of those only if all are. */
void explain_start(const device *d);

#endif

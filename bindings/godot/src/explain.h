/* Why surfaces cannot be felt, or not as asked for. SPDX-License-Identifier: MIT */
#ifndef KNURL_GODOT_EXPLAIN_H
#define KNURL_GODOT_EXPLAIN_H

#include "world.h"

/* A line each, in a caller's buffer; "" where all is well. In the editor: what the devices that stand in the tree would
 * say, by their presets; in a game: what those that run do say. */
void explain_surface(surface *s, char *text, size_t size);

/* The same of a device. */
void explain_device(const device *d, char *text, size_t size);

/* When a device starts: warns of all that is not felt as asked for, once, and of many only the first. */
void explain_start(void);

#endif

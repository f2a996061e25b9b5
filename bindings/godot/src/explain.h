/* Why surfaces cannot be felt, or not as asked for. SPDX-License-Identifier: MIT */
#ifndef KNURL_GODOT_EXPLAIN_H
#define KNURL_GODOT_EXPLAIN_H

#include "world.h"

/* A line each, in a caller's buffer; "" where all is well. In the editor: what the devices that stand in the tree would
 * say, by their presets; in a game: what those that run do say. */
void explain_surface(surface *s, char *text, size_t size);

/* The same of a device. */
void explain_device(const device *d, char *text, size_t size);

/* Keeps what was said of a surface, instead of what was kept before; null: nothing. */
void explain_keep(surface *s, const char *text);

/* When a device starts: warns of all that is not felt as asked for, once, and of many only the first. */
void explain_start(void);

/* Has the editor ask again for the warnings of a node, or of all surfaces. */
void explain_again(const gd_instance *node);
void explain_all_again(void);

/* Appends lines to a PackedStringArray; cuts them apart. */
void explain_give(char *text, void *strings);

#endif

/* Warnings: kept with their surface, and given to the editor. Their texts are made in explain.c.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_GODOT_WARNINGS_H
#define KNURL_GODOT_WARNINGS_H

#include "world.h"

/* Keeps a surface's warnings, in place of those that were kept before; null: none. */
void warnings_keep(surface *s, const char *text);

/* Makes the editor ask for the warnings of a node, or of all surfaces, again. */
void warnings_refresh(const gd_instance *node);
void warnings_refresh_all(void);

/* Appends lines to a PackedStringArray; cuts them apart. */
void warnings_append(char *text, void *strings);

#endif

/* Warnings: stored with their surface, and passed to the editor. Their texts are made in explain.c.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_GODOT_WARNINGS_H
#define KNURL_GODOT_WARNINGS_H

#include "world.h"

/* Stores a surface's warnings, replacing the previous ones; null: no warnings. */
void warnings_keep(surface *s, const char *text);

/* Makes the editor fetch the warnings of a node, or of all surfaces, again. */
void warnings_refresh(const gd_instance *node);
void warnings_refresh_all(void);

/* Splits a text at line ends (in place) and appends the lines to a PackedStringArray. */
void warnings_append(char *text, void *strings);

#endif

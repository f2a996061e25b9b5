/* Warnings: kept with their surface, and given to the editor. What they say is explain's. SPDX-License-Identifier: MIT
 */
#ifndef KNURL_GODOT_SAID_H
#define KNURL_GODOT_SAID_H

#include "world.h"

/* Keeps what was said of a surface, instead of what was kept before; null: nothing. */
void said_keep(surface *s, const char *text);

/* Has the editor ask again for the warnings of a node, or of all surfaces. */
void said_again(const gd_instance *node);
void said_all_again(void);

/* Appends lines to a PackedStringArray; cuts them apart. */
void said_give(char *text, void *strings);

#endif

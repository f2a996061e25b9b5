/* Why surfaces cannot be felt, or not as asked for. SPDX-License-Identifier: MIT */
#ifndef KNURL_GODOT_EXPLAIN_H
#define KNURL_GODOT_EXPLAIN_H

#include "world.h"

/* A line each, in a caller's buffer; "" where all is well. */
void explain_surface(const surface *s, char *text, size_t size);

#endif

/* Warnings of surfaces that cannot be felt, or differ from their settings. SPDX-License-Identifier: MIT */
#ifndef KNURL_GODOT_EXPLAIN_H
#define KNURL_GODOT_EXPLAIN_H

#include "world.h"

/* One line per warning, in a caller's buffer; "" if there are no problems. In the editor by the limits of the devices
 * in the tree, from their presets; in a game by those of the running devices, or of `only` alone if it is not null. */
void explain_surface(surface *s, const device *only, char *text, size_t size);

/* The same for a device. */
void explain_device(const device *d, char *text, size_t size);

/* Called when a device starts: warns of surfaces that it cannot render by their settings; only of the first few, and of
 * each once per process, because games start their devices again in each scene. Most surfaces of a game are out of
 * reach, so it warns of those only if all are. */
void explain_start(const device *d);

#endif

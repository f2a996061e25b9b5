/* KnurlEffect: a spring, notches or a guide at a node. SPDX-License-Identifier: MIT */
#ifndef KNURL_GODOT_EFFECT_H
#define KNURL_GODOT_EFFECT_H

#include "world.h"

extern const gd_class effect_class;

/* Gives a running device the effects in the tree that are on its layers, if they have changed since the last call.
 * delta: s of a frame, in which they move. */
void effects_follow(const device *d, double delta);

/* Takes them from a device that has a slot. */
void effects_take_off(const device *d);

#endif

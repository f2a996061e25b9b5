/* Surfaces into a device's scene, along with their nodes, and out. Errors are pushed.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_GODOT_FOLLOW_H
#define KNURL_GODOT_FOLLOW_H

#include "world.h"

/* Puts a surface as it is now into the device's scene, in place of its former state; removes one that cannot be felt.
 */
void follow_put(device *d, surface *s);
void follow_remove(device *d, surface *s);

void follow_all(device *d);

/* After some were put: tells how many failed beyond those that were told of one by one. */
void follow_count_failures(device *d);

/* 1: it is in the scene of a running device. */
int follow_is_felt(const surface *s);

#endif

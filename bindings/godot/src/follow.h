/* Adds surfaces to a device's scene, moves them with their nodes, and removes them. Errors are logged.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_GODOT_FOLLOW_H
#define KNURL_GODOT_FOLLOW_H

#include "world.h"

/* Adds a surface in its present state to the device's scene, replacing its former state; removes one that cannot be
 * felt.
 */
void follow_put(device *d, surface *s);
void follow_remove(device *d, surface *s);

void follow_all(device *d);

/* Call it after a series of follow_put(): logs the number of failures that were not logged one by one. */
void follow_count_failures(device *d);

/* 1: it is in the scene of a running device. */
int follow_is_felt(const surface *s);

#endif

/* A gamepad's motors play a device's force. SPDX-License-Identifier: MIT */
#ifndef KNURL_GODOT_RUMBLE_H
#define KNURL_GODOT_RUMBLE_H

#include "world.h"

/* Called each frame of a running device: sets the motors of the gamepad that the property rumble names. */
void rumble_play(device *d);

/* Stops them: the run ends, or another gamepad comes. */
void rumble_stop(device *d);

#endif

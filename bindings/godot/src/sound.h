/* The sound of what a KnurlDevice feels, played by an AudioStreamPlayer below it.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_GODOT_SOUND_H
#define KNURL_GODOT_SOUND_H

#include "world.h"

/* The stream that the player has, and what it makes of it. Scripts do not see these classes. */
extern const gd_class sound_stream_class;
extern const gd_class sound_playback_class;

/* Plays, or no longer plays, what the running device feels. Errors: those of knurl_session_get_sound(). */
knurl_result sound_start(const device *d);
void sound_stop(const device *d);

#endif

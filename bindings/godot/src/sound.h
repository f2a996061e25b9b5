/* The sound of a KnurlDevice, played by an AudioStreamPlayer below it.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_GODOT_SOUND_H
#define KNURL_GODOT_SOUND_H

#include "world.h"

/* The player's stream and its playback. Scripts do not see these classes. */
extern const gd_class sound_stream_class;
extern const gd_class sound_playback_class;

/* Starts or stops the sound of the running device. Errors: those of knurl_session_get_sound(). */
knurl_result sound_start(const device *d);
void sound_stop(const device *d);

/* The engine's, Hz. */
double sound_mix_rate(void);

#endif

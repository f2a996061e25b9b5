/* A run's sound as a WAV file: mono, 48 kHz, 16 bits. SPDX-License-Identifier: MIT */
#ifndef KNURL_TOOL_SOUND_H
#define KNURL_TOOL_SOUND_H

#include "tool.h"

#include <knurl/audio.h>

typedef struct sound {
    knurl_audio *audio; /* with its user for knurl_audio_take() */
    out_file file;
    double rate;     /* ticks per second */
    uint64_t ticks;  /* taken; atomic, counted by the haptic thread */
    uint64_t frames; /* written */
} sound;

/* Opens the file. TOOL_OK, or TOOL_FAILURE after printing the reason. */
int sound_open(sound *s, const char *path, double rate);

/* Adds a tick. [haptic thread] */
void sound_take(sound *s, const knurl_tick_output *output);

/* Writes the new samples; call it at least every 16384 ticks. */
void sound_drain(sound *s);

/* Drains and keeps the file, or removes it. TOOL_OK, or TOOL_FAILURE after printing the reason. */
int sound_close(sound *s, int keep);

#endif

/* A run's sound as a WAV file: mono, 48 kHz, 16 bits. SPDX-License-Identifier: MIT */
#ifndef KNURL_TOOL_SOUND_H
#define KNURL_TOOL_SOUND_H

#include "tool.h"

#include <knurl/audio.h>

typedef struct sound {
    knurl_audio *audio; /* its user for knurl_audio_take() */
    out_file file;
    double rate;     /* ticks per second */
    uint64_t ticks;  /* taken; atomic, counted by the haptic thread */
    uint64_t frames; /* written */
} sound;

/* Opens the file. TOOL_OK, or TOOL_FAILURE having said why. */
int sound_open(sound *s, const char *path, double rate);

/* One tick more. [haptic thread] */
void sound_take(sound *s, const knurl_tick_output *output);

/* Writes what has come; to be called at least every 16384 ticks. */
void sound_drain(sound *s);

/* Drains and keeps the file, or takes it away. TOOL_OK, or TOOL_FAILURE having said why. */
int sound_close(sound *s, int keep);

#endif

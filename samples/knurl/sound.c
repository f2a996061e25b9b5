/* A run's sound as a WAV file. SPDX-License-Identifier: MIT */
#include "sound.h"

#include <math.h>
#include <string.h>

#define SAMPLE_RATE 48000
#define BLOCK       480
#define HEADER      44
#define LONGEST     (UINT32_MAX - HEADER) /* bytes that a WAV file's header can hold */

static void put(FILE *f, uint32_t value, int bytes) {
    for (int i = 0; i < bytes; i++) {
        (void)fputc((int)(value >> (8 * i) & 0xff), f);
    }
}

/* Until the lengths are known, they are those of a stream of unknown length. */
static void write_header(FILE *f, uint64_t frames) {
    const uint32_t bytes = frames < LONGEST / 2 ? (uint32_t)frames * 2 : LONGEST;
    fputs("RIFF", f);
    put(f, bytes + HEADER - 8, 4);
    fputs("WAVEfmt ", f);
    put(f, 16, 4); /* size of this chunk */
    put(f, 1, 2);  /* integers */
    put(f, 1, 2);  /* channels */
    put(f, SAMPLE_RATE, 4);
    put(f, SAMPLE_RATE * 2, 4); /* bytes per second */
    put(f, 2, 2);               /* bytes per frame */
    put(f, 16, 2);              /* bits per sample */
    fputs("data", f);
    put(f, bytes, 4);
}

int sound_open(sound *s, const char *path, double rate) {
    knurl_audio_desc desc;
    memset(s, 0, sizeof *s);
    s->rate = rate;
    knurl_audio_desc_init(&desc, sizeof desc);
    desc.update_rate_hz = rate;
    desc.sample_rate_hz = SAMPLE_RATE;
    desc.latency_s = 0.0;
    desc.is_offline = 1;
    int code = out_open(&s->file, path);
    if (code == TOOL_OK && knurl_audio_create(&desc, &s->audio)) {
        code = tool_library_error(TOOL_FAILURE, "run: --wav");
        out_discard(&s->file);
    }
    if (code == TOOL_OK) {
        write_header(s->file.stream, LONGEST);
    }
    return code;
}

void sound_take(sound *s, const knurl_tick_output *output) {
    knurl_audio_take(output, s->audio);
    __atomic_store_n(&s->ticks, s->ticks + 1, __ATOMIC_RELEASE);
}

/* Writes up to the start of a tick. */
static void write_until(sound *s, double tick) {
    const uint64_t until = (uint64_t)(fmax(0.0, tick) * SAMPLE_RATE / s->rate);
    while (s->frames < until) {
        float samples[BLOCK];
        const uint32_t count = until - s->frames < BLOCK ? (uint32_t)(until - s->frames) : BLOCK;
        knurl_audio_fill(s->audio, samples, count);
        for (uint32_t i = 0; i < count; i++) {
            put(s->file.stream, (uint32_t)(int32_t)lrintf(32767.0f * samples[i]), 2);
        }
        s->frames += count;
    }
}

void sound_drain(sound *s) { /* a tick is played once the next one has arrived */
    write_until(s, (double)__atomic_load_n(&s->ticks, __ATOMIC_ACQUIRE) - 1.0);
}

int sound_close(sound *s, int keep) {
    int code = TOOL_OK;
    if (!s->audio) {
        return code;
    }
    sound_drain(s);
    write_until(s, (double)s->ticks);
    knurl_audio_destroy(s->audio);
    s->audio = NULL;
    if (!keep) {
        out_discard(&s->file);
        return code;
    }
    if (fseek(s->file.stream, 0, SEEK_SET) == 0) { /* not a pipe */
        write_header(s->file.stream, s->frames);
    }
    return out_keep(&s->file);
}

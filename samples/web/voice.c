/* The page's ticks for actuators: samples for a voice coil, and strengths for a gamepad's two motors.
 * SPDX-License-Identifier: MIT */
#include "web.h"

#include <knurl/audio.h>

#include <emscripten.h>

static knurl_audio *voice;

/* Starts it for ticks at `rate` (Hz), and samples at `sample_rate`; 0: ends it. */
EMSCRIPTEN_KEEPALIVE int web_voice(double rate, double sample_rate) {
    knurl_audio_desc desc;
    knurl_audio_desc_init(&desc, sizeof desc);
    desc.is_offline = 1; /* the page's queue makes up for uneven threads */
    desc.voice = KNURL_VOICE_COIL;
    desc.update_rate_hz = rate;
    desc.sample_rate_hz = sample_rate;
    knurl_audio_destroy(voice);
    voice = NULL;
    return rate > 0.0 ? knurl_audio_create(&desc, &voice) : KNURL_OK;
}

void web_voice_take(const knurl_tick_output *tick) {
    if (voice) {
        knurl_audio_take(tick, voice);
    }
}

/* samples: `count`, -1 to 1, of the ticks since the last call; zeros without a voice. rumble: slow and fast motor. */
EMSCRIPTEN_KEEPALIVE void web_voice_fill(float *samples, uint32_t count, double rumble[2]) {
    for (uint32_t i = 0; i < count; i++) {
        samples[i] = 0.0f;
    }
    knurl_audio_fill(voice, samples, count);
    if (!voice || knurl_audio_get_rumble(voice, rumble)) {
        rumble[0] = rumble[1] = 0.0;
    }
}

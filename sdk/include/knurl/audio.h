/* Knurl: the sound of a grating, from the same height map that is felt. The haptic thread hands over where each tick is
 * on the grating; the audio thread asks for samples. Neither waits for the other. The signal is mono: for a
 * loudspeaker, and just as well for a voice coil or a gamepad's haptic channels. SPDX-License-Identifier: MIT */
#ifndef KNURL_AUDIO_H
#define KNURL_AUDIO_H

#include <knurl/scene.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct knurl_audio knurl_audio;

typedef struct knurl_audio_desc {
    uint32_t struct_size;  /**< set by knurl_audio_desc_init() */
    uint32_t is_offline;   /**< 1: for a file: no tick is left out, and none is played faster or slower; default 0 */
    double update_rate_hz; /**< of the ticks, KNURL_UPDATE_RATE_MIN to _MAX; default 1000 */
    double sample_rate_hz; /**< of the sound, 8000 to 192000; default 48000 */
    double full_scale;     /**< N, > 0: a texture that swings the force by this much up and down plays at +-0.5; louder
                                ones too. Default 0.25 */
    double latency_s; /**< s of ticks kept in reserve, against audio and haptic threads that do not run evenly: 0 to
                           0.1; default 0.01 */
} knurl_audio_desc;

/** Fills in defaults; `size` is the caller's sizeof. [any thread] */
KNURL_API void knurl_audio_desc_init(knurl_audio_desc *desc, uint32_t size);

/** Makes the sound of one HIP. desc: null for all defaults. All memory is had here. Errors: KNURL_ERROR_ARGUMENT,
 * KNURL_ERROR_MEMORY. [game thread] */
KNURL_API knurl_result knurl_audio_create(const knurl_audio_desc *desc, knurl_audio **audio);

/** Gives everything back; null is allowed. No tick may be handed over and no sample asked for any more. [game thread]
 */
KNURL_API void knurl_audio_destroy(knurl_audio *audio);

/** Hands over a tick: a knurl_tick_callback, with the audio as `user`, for every tick in order. A tick for which there
 * is no room, because nobody asked for samples for 16384 ticks, is dropped. [haptic thread] */
KNURL_API void knurl_audio_take(const knurl_tick_output *output, void *audio) KNURL_NONBLOCKING;

/** The next `count` samples, -1 to 1. Between two ticks the HIP moves evenly over the grating, and its way is smoothed
 * by 4 ms, because encoders count. The sound is the mean of Eq. 11's height map over the way of each eighth of a
 * sample, low-passed to 16 kHz (at 48 kHz) and high-passed at 20 Hz: lines at f_t and its odd harmonics, on a grid at
 * sums and differences of both axes' frequencies; aliases are 60 dB lower, also beyond f_h/2. Its loudness is how far
 * the force changes where the height does, over the latest 32 to 64 ms; touch, lift and changes of loudness fade over
 * up to 5 ms. It is exactly 0 before the first tick, and at most 0.5 s after the last motion. A sample comes latency_s
 * + 2 ticks + 4.2 ms after its tick, plus at most 20 ms and a further `count` samples where the audio thread was late;
 * beyond that ticks are left out. A difference between the two clocks of up to 0.5 % is made up for by playing faster
 * or slower. samples: the caller's. Null: nothing is done. [audio thread, one an audio] */
KNURL_API void knurl_audio_fill(knurl_audio *audio, float *samples, uint32_t count) KNURL_NONBLOCKING;

/** s: from the latest tick that was handed over to the latest sample that was asked for; 0 before the first sample or
 * for null. [audio thread] */
KNURL_API double knurl_audio_get_latency(const knurl_audio *audio) KNURL_NONBLOCKING;

#ifdef __cplusplus
}
#endif
#endif

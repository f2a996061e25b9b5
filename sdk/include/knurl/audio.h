/* Knurl: the sound of a grating, from the same height map that is felt. The haptic thread queues each tick's position
 * on the grating; the audio thread renders samples. Neither waits for the other. The signal is mono: for a loudspeaker,
 * a voice coil or a gamepad's haptic channels. SPDX-License-Identifier: MIT */
#ifndef KNURL_AUDIO_H
#define KNURL_AUDIO_H

#include <knurl/hip.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct knurl_audio knurl_audio;

typedef struct knurl_audio_desc {
    uint32_t struct_size;  /**< set by knurl_audio_desc_init() */
    uint32_t is_offline;   /**< 1: for rendering to a file: no tick is skipped or played faster or slower; default 0 */
    double update_rate_hz; /**< ticks per second, KNURL_UPDATE_RATE_MIN to _MAX; default 1000 */
    double sample_rate_hz; /**< samples per second, 8000 to 192000; default 48000 */
    double latency_s;      /**< s of ticks kept in reserve, because audio and haptic threads run unevenly: 0 to 0.1;
                                default 0.01 */
} knurl_audio_desc;

/** Fills in defaults; `size` is the caller's sizeof. [any thread] */
KNURL_API void knurl_audio_desc_init(knurl_audio_desc *desc, uint32_t size);

/** Creates the sound of one HIP. desc: null for all defaults. All memory is allocated here. Errors:
 * KNURL_ERROR_ARGUMENT, KNURL_ERROR_MEMORY. [game thread] */
KNURL_API knurl_result knurl_audio_create(const knurl_audio_desc *desc, knurl_audio **audio);

/** Frees it; null is allowed. No knurl_audio_take() or knurl_audio_fill() may run then or later. [game thread] */
KNURL_API void knurl_audio_destroy(knurl_audio *audio);

/** Queues a tick. Call it for every tick in order: it is a knurl_tick_callback with the audio as `user`. The queue
 * holds 16384 ticks; if it is full, the tick is dropped. [haptic thread] */
KNURL_API void knurl_audio_take(const knurl_tick_output *output, void *audio) KNURL_NONBLOCKING;

/** Renders the next `count` samples, -1 to 1, into the caller's array. Does nothing if audio or samples is null. [audio
 * thread, one per audio]
 * - Height: the mean of Eq. 11's height map over each eighth of a sample, low-passed to 16 kHz (at 48 kHz) and
 *   high-passed at 20 Hz: lines at f_t and its odd harmonics, on a grid at sums and differences of both axes'
 *   frequencies. Aliases are 60 dB lower, even if f_t is above f_h/2. Between two ticks the HIP moves evenly over the
 *   grating; its motion is smoothed by 4 ms, because encoders quantise it.
 * - Loudness: the change of the force at changes of the height, over the last 32 to 64 ms: plus and minus 0.25 N, or
 *   more, play at +-0.5. A fundamental alone is as loud as its square wave. Touch, lift and changes of loudness
 *   fade over up to 5 ms. The sound is exactly 0 before the first tick, and within 0.5 s of the last motion.
 * - Latency: a sample comes latency_s + 2 ticks + 4.2 ms after its tick, plus at most 20 ms and another `count` samples
 *   if the audio thread was late; ticks beyond that are skipped. A difference of up to 0.5 % between the two threads'
 *   clocks is compensated by playing faster or slower. */
KNURL_API void knurl_audio_fill(knurl_audio *audio, float *samples, uint32_t count) KNURL_NONBLOCKING;

#ifdef __cplusplus
}
#endif
#endif

/* Knurl: a HIP's signal for ears and for other actuators: sound from the same height map that is felt, or the force
 * itself for voice coils and gamepads. The haptic thread queues each tick; the audio thread renders samples. Neither
 * waits for the other. The signal is mono, one for each HIP. SPDX-License-Identifier: MIT */
#ifndef KNURL_AUDIO_H
#define KNURL_AUDIO_H

#include <knurl/hip.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct knurl_audio knurl_audio;

/** The signals that knurl_audio_fill() renders. */
enum {
    KNURL_VOICE_EAR = 0, /**< the sound of the grating, for loudspeakers */
    KNURL_VOICE_COIL = 1 /**< the force, for voice coils and a gamepad's haptic channels */
};

typedef struct knurl_audio_desc {
    uint32_t struct_size;  /**< set by knurl_audio_desc_init() */
    uint32_t is_offline;   /**< 1: for rendering to a file: no tick is skipped or played faster or slower; default 0 */
    double update_rate_hz; /**< ticks per second, KNURL_UPDATE_RATE_MIN to _MAX; default 1000 */
    double sample_rate_hz; /**< samples per second, 8000 to 192000; default 48000 */
    double latency_s;      /**< s of ticks kept in reserve, because audio and haptic threads run unevenly: 0 to 0.1;
                                KNURL_DEFAULT (default): 0.01, for a COIL 0.001 */
    int32_t voice;         /**< KNURL_VOICE_; default EAR */
    uint32_t reserved;     /**< 0 */
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
 *
 * KNURL_VOICE_COIL: a sample is the force as sent, N, along the contact's normal or, without contact, along the
 * direction in which it began (effects); longer forces are clipped at 1 N.
 * - It has the steps of ridges as their method plays them, touches, lifts and presses, from 3 Hz up (first order): flat
 *   within 1 dB from 10 Hz to 0.4 f_h, -6 dB at f_h/2; images of ticks are 38 dB lower from 0.65 f_h on.
 * - Latency: a sample comes at most latency_s + 4 ticks after its tick, at 1 kHz 5 ms, and `count` samples. Late
 *   threads and clocks that differ are dealt with as for ears. The signal is exactly 0 once the force is constant.
 *
 * KNURL_VOICE_EAR:
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

/** The force for a gamepad's two rumble motors, with either voice: rumble[0] for the slow, heavy one, from 3 to 80 Hz,
 * rumble[1] for the fast, light one, above (second order); each 0 to 1, the amplitude in N of a sine of the same mean
 * power over the last 25 ms. Call it as often as the motors are set. Errors: KNURL_ERROR_ARGUMENT. [any thread] */
KNURL_API knurl_result knurl_audio_get_rumble(const knurl_audio *audio, double rumble[2]);

#ifdef __cplusplus
}
#endif
#endif

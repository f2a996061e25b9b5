/* Ticks of a HIP over a grating like a scene's output, by the equations: K (H + depth), H by Eq. 11.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_TICKS_H
#define KNURL_TEST_TICKS_H

#include <knurl/audio.h>

#include "support/close.h"

#define PI        3.14159265358979323846
#define STIFFNESS 400.0
#define AMPLITUDE 2e-4
#define DEPTH     1e-3
#define SWING     (STIFFNESS * AMPLITUDE) /* N, up and down */
#define RATE      48000.0
#define A_TICK    48 /* samples */

/* The HIP at x, y cycles, moving with f_t. */
static inline knurl_tick_output tick_on(double x, double y, double f_t) {
    knurl_tick_output tick;
    memset(&tick, 0, sizeof tick);
    tick.flags = KNURL_TICK_CONTACT;
    tick.contacts = 1;
    tick.cycles[0] = x;
    tick.cycles[1] = y;
    tick.temporal_frequency = f_t;
    tick.depth = DEPTH;
    tick.height = (cos(2.0 * PI * x) > 0.0) == (cos(2.0 * PI * y) > 0.0) ? AMPLITUDE : -AMPLITUDE;
    tick.force[2] = STIFFNESS * (DEPTH + tick.height);
    return tick;
}

static inline knurl_tick_output tick_off(void) {
    knurl_tick_output tick;
    memset(&tick, 0, sizeof tick);
    return tick;
}

/* The amplitude of a line in `count` samples. */
static inline double line_at(const float *window, int count, double hz) {
    double c = 0.0, s = 0.0;
    for (int i = 0; i < count; i++) {
        c += window[i] * cos(2.0 * PI * hz * i / RATE);
        s += window[i] * sin(2.0 * PI * hz * i / RATE);
    }
    return 2.0 * sqrt(c * c + s * s) / count;
}

static inline knurl_audio *make_audio(double latency_s) {
    knurl_audio *audio = NULL;
    knurl_audio_desc desc;
    knurl_audio_desc_init(&desc, sizeof desc);
    desc.latency_s = latency_s;
    assert_int_equal(knurl_audio_create(&desc, &audio), KNURL_OK);
    return audio;
}

#endif

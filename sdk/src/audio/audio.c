/* The sound or the force of a HIP, as a signal. The haptic thread writes a ring of ticks, the audio thread reads it:
 * each tick is a step over the grating and a loudness, for a coil also a force. SPDX-License-Identifier: MIT */
#include <knurl/audio.h>

#include "audio/coil.h"
#include "audio/loudness.h"
#include "audio/wave.h"
#include "base/atomic.h"
#include "base/base.h"
#include "base/rule.h"

#include <math.h>
#include <stdlib.h>

#define RING_TICKS    16384 /* 1.6 s at 10 kHz */
#define LATE_S        0.02  /* ticks are skipped if the lag is longer than this */
#define FADE_S        0.005 /* fade between silence and full scale */
#define FULL_SCALE    0.25  /* N: a change of the force by plus and minus this much is as loud as it gets */
#define DRIFT_MAX     0.005 /* the largest relative change of speed */
#define DRIFT_S       2.0   /* time to catch up with a lag */
#define EVEN_TICKS    2.0   /* ticks: a lag below this is the jitter of the threads, not drift */
#define HIGHEST_HZ    20000.0
#define SMOOTH_S      0.004 /* time constant of the smoothing of steps: four ticks of a Touch */
#define SMALLEST_STEP 1e-6
#define SMALLEST      1e-9 /* ticks: sums of fractions are not exact */

typedef struct audio_tick {
    double step[2];  /* cycles since the previous tick */
    double loudness; /* 0 to 1 */
    double force;    /* N */
} audio_tick;

struct knurl_audio {
    uint32_t handle; /* KNURL_HANDLE_AUDIO, first */
    uint32_t reserved;
    knurl_audio_desc desc;
    audio_tick *ring;
    /* atomics */
    uint64_t written, read;
    /* used by the haptic thread only */
    knurl_loudness loudness;
    double cycles[2];
    double due[2]; /* cycles passed but not queued yet */
    double share;  /* part of `due` queued per tick */
    uint32_t in_contact;
    knurl_rumble rumble; /* its powers are read by any thread */
    /* used by the audio thread only */
    uint32_t plays; /* 1: enough ticks were queued to begin */
    double at;      /* between tick `read` and the next, 0 to 1 */
    double place[2];
    double level;
    knurl_wave_filter filter;
    knurl_coil coil;
    uint64_t pushed; /* ticks given to the coil */
};

void knurl_audio_desc_init(knurl_audio_desc *desc, uint32_t size) {
    const knurl_audio_desc defaults = {sizeof defaults, 0, 1000.0, 48000.0, KNURL_DEFAULT, KNURL_VOICE_EAR, 0};
    knurl_desc_write(&defaults, sizeof defaults, desc, size);
}

static knurl_result check(const char *key, const char *unit, double value, double least, double most) {
    return knurl_is_within(value, least, most)
               ? KNURL_OK
               : knurl_fail(KNURL_ERROR_ARGUMENT, "%s: expected %g to %g %s, found %g", key, least, most, unit, value);
}

static knurl_result check_desc(const knurl_audio_desc *d) {
    knurl_result result =
        check("update_rate_hz", "Hz", d->update_rate_hz, KNURL_UPDATE_RATE_MIN, KNURL_UPDATE_RATE_MAX);
    if (!result && d->is_offline > 1) {
        result = knurl_fail(KNURL_ERROR_ARGUMENT, "is_offline: expected 0 or 1, found %u", (unsigned)d->is_offline);
    }
    result = result ? result : check("sample_rate_hz", "Hz", d->sample_rate_hz, 8000.0, 192000.0);
    result = result ? result : check("latency_s", "s", d->latency_s, 0.0, 0.1);
    if (!result && ((d->voice != KNURL_VOICE_EAR && d->voice != KNURL_VOICE_COIL) || d->reserved != 0)) {
        result =
            knurl_fail(KNURL_ERROR_ARGUMENT,
                       "voice: expected %d (KNURL_VOICE_EAR) or %d (KNURL_VOICE_COIL), and reserved 0, found %d, %u",
                       KNURL_VOICE_EAR, KNURL_VOICE_COIL, (int)d->voice, (unsigned)d->reserved);
    }
    return result;
}

knurl_result knurl_audio_create(const knurl_audio_desc *desc, knurl_audio **audio) {
    KNURL_RULE(GAME, NULL);
    knurl_audio_desc d;
    if (KNURL_IS_NULL(audio)) {
        return KNURL_ERROR_ARGUMENT;
    }
    knurl_audio_desc_init(&d, sizeof d);
    knurl_result result = desc ? knurl_desc_read("knurl_audio_desc", desc, &d, sizeof d) : KNURL_OK;
    if (d.latency_s == KNURL_DEFAULT) {
        d.latency_s = d.voice == KNURL_VOICE_COIL ? 0.001 : 0.01;
    }
    result = result ? result : check_desc(&d);
    if (result) {
        return result;
    }
    knurl_audio *a = calloc(1, sizeof *a);
    audio_tick *ring = calloc(RING_TICKS, sizeof *ring);
    if (!a || !ring) {
        free(a);
        free(ring);
        return knurl_fail(KNURL_ERROR_MEMORY, "knurl_audio_create: no memory for %d ticks", RING_TICKS);
    }
    a->desc = d;
    a->ring = ring;
    a->share = 1.0 - exp(-1.0 / (SMOOTH_S * d.update_rate_hz));
    knurl_loudness_init(&a->loudness, d.update_rate_hz);
    knurl_wave_filter_init(&a->filter, d.sample_rate_hz);
    knurl_rumble_init(&a->rumble, d.update_rate_hz);
    knurl_coil_init(&a->coil, d.sample_rate_hz);
    a->handle = KNURL_HANDLE_AUDIO;
    *audio = a;
    return KNURL_OK;
}

void knurl_audio_destroy(knurl_audio *audio) {
    KNURL_RULE(GAME, audio);
    if (!audio || KNURL_BAD_HANDLE(audio, AUDIO)) {
        return;
    }
    knurl_handle_clear(&audio->handle);
    free(audio->ring);
    free(audio);
}

/* --- the haptic thread --- */

/* Cycles along one axis since the last tick. A jump not caused by motion, for example at a uv seam or after a change of
 * material, is reduced to its fraction of a cycle. likely: cycles expected from f_t. */
static double find_step(double to, double from, double likely, double most) {
    double step = to - from;
    if (!(fabs(step) <= 4.0 * likely + 1.0)) {
        step -= floor(step + 0.5);
    }
    return fabs(step) <= most ? step : 0.0; /* not finite: 0 too */
}

/* Spreads a step over several ticks, because an encoder's counts arrive only in some ticks. Keeps the sum. */
static double smooth(knurl_audio *a, int axis, double step) {
    const double due = a->due[axis] + step;
    const double queued = fabs(due) < SMALLEST_STEP ? due : due * a->share;
    a->due[axis] = due - queued;
    return queued;
}

void knurl_audio_take(const knurl_tick_output *output, void *audio) {
    KNURL_RULE(HAPTIC, audio);
    knurl_audio *a = audio;
    if (!output || !KNURL_IS_HANDLE(a, AUDIO)) {
        return;
    }
    const double rate = a->desc.update_rate_hz;
    const double likely = output->temporal_frequency / rate;
    const uint32_t in_contact = output->flags & KNURL_TICK_CONTACT;
    audio_tick tick = {{0.0, 0.0}, 0.0, 0.0};
    tick.force = knurl_rumble_update(&a->rumble, output);
    tick.loudness = fmin(1.0, knurl_loudness_update(&a->loudness, output) / FULL_SCALE);
    for (int i = 0; i < 2; i++) {
        const int moves = in_contact && a->in_contact;
        tick.step[i] =
            moves ? smooth(a, i, find_step(output->cycles[i], a->cycles[i], likely, HIGHEST_HZ / rate)) : 0.0;
    }
    a->in_contact = in_contact;
    a->cycles[0] = output->cycles[0];
    a->cycles[1] = output->cycles[1];
    if (a->written - knurl_load_acquire(&a->read) < RING_TICKS) {
        a->ring[a->written % RING_TICKS] = tick;
        knurl_store_release(&a->written, a->written + 1);
    }
}

/* --- the audio thread --- */

/* Ticks per sample for the next `count` samples, with `written` ticks queued so far; 0 if too few to begin. Skips ticks
 * that are too late. find_level() needs the tick after the playing one too. */
static double choose_pace(knurl_audio *a, uint64_t written, uint32_t count) {
    const double rate = a->desc.update_rate_hz;
    const double pace = rate / a->desc.sample_rate_hz;
    const double reserve = (double)(written - a->read) - 1.0 - a->at - pace * count;
    const double lag = reserve - rate * a->desc.latency_s;
    a->plays |= lag >= -SMALLEST * count;
    if (!a->plays) {
        return 0.0;
    }
    if (a->desc.is_offline) {
        return pace;
    }
    if (lag > rate * LATE_S) {
        knurl_store_release(&a->read, a->read + (uint64_t)lag);
        return pace;
    }
    return fabs(lag) < EVEN_TICKS ? pace : pace * (1.0 + fmax(-DRIFT_MAX, fmin(DRIFT_MAX, lag / (rate * DRIFT_S))));
}

/* Advances by `ticks` if that many are queued: the playing tick and one more. */
static void advance(knurl_audio *a, uint64_t written, double ticks) {
    while (ticks > SMALLEST && a->plays) {
        if (a->at > 1.0 - SMALLEST) {
            a->plays = written - a->read > 2;
            a->at = a->plays ? 0.0 : a->at;
            knurl_store_release(&a->read, a->read + a->plays);
            continue;
        }
        const double *step = a->ring[a->read % RING_TICKS].step;
        const double part = fmin(ticks, 1.0 - a->at);
        a->place[0] += part * step[0];
        a->place[1] += part * step[1];
        a->at += part;
        ticks -= part;
    }
}

/* Advances by an eighth of a sample and returns the mean height over it. */
static double move(knurl_audio *a, uint64_t written, double ticks) {
    a->place[0] -= floor(a->place[0]);
    a->place[1] -= floor(a->place[1]);
    const double from[2] = {a->place[0], a->place[1]};
    advance(a, written, ticks);
    return knurl_wave_mean(from, a->place);
}

/* Fades towards the louder of the playing tick and the next one, so that the fade-in precedes an edge. */
static double find_level(knurl_audio *a) {
    const double most = 1.0 / (FADE_S * a->desc.sample_rate_hz);
    double wanted = 0.0;
    if (a->plays) {
        wanted = fmax(a->ring[a->read % RING_TICKS].loudness, a->ring[(a->read + 1) % RING_TICKS].loudness);
    }
    a->level += fmax(-most, fmin(most, wanted - a->level));
    return a->level;
}

static double next_for_ears(knurl_audio *a, uint64_t written, double ticks) {
    for (int k = 0; k < KNURL_WAVE_OVERSAMPLING; k++) {
        knurl_wave_filter_push(&a->filter, move(a, written, ticks / KNURL_WAVE_OVERSAMPLING));
    }
    return 0.5 * find_level(a) * knurl_wave_filter_pull(&a->filter);
}

/* The coil has the playing tick and the next. Those before skipped ones do not matter. */
static double next_for_coil(knurl_audio *a, uint64_t written, double ticks) {
    advance(a, written, ticks);
    const uint64_t wanted = a->plays ? a->read + 2 : a->pushed;
    if (wanted > a->pushed + KNURL_COIL_TAPS) {
        a->pushed = wanted - KNURL_COIL_TAPS;
    }
    while (a->pushed < wanted) {
        knurl_coil_push(&a->coil, a->ring[a->pushed++ % RING_TICKS].force);
    }
    return knurl_coil_pull(&a->coil, a->at);
}

void knurl_audio_fill(knurl_audio *a, float *samples, uint32_t count) {
    KNURL_RULE(ONE, a);
    if (!KNURL_IS_HANDLE(a, AUDIO) || !samples || count == 0) {
        return;
    }
    const uint64_t written = knurl_load_acquire(&a->written);
    const double ticks = choose_pace(a, written, count);
    for (uint32_t i = 0; i < count; i++) {
        const double sample =
            a->desc.voice == KNURL_VOICE_COIL ? next_for_coil(a, written, ticks) : next_for_ears(a, written, ticks);
        samples[i] = (float)fmax(-1.0, fmin(1.0, sample));
    }
}

/* --- any thread --- */

knurl_result knurl_audio_get_rumble(const knurl_audio *audio, double rumble[2]) {
    if (KNURL_BAD_HANDLE(audio, AUDIO) || KNURL_IS_NULL(rumble)) {
        return KNURL_ERROR_ARGUMENT;
    }
    for (int band = 0; band < 2; band++) {
        rumble[band] = fmin(1.0, sqrt(2.0 * knurl_load_double(&audio->rumble.power[band])));
    }
    return KNURL_OK;
}

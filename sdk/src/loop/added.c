/* A game's additions to the surfaces' forces: a gain on the sum, a force, a vibration. SPDX-License-Identifier: MIT */
#include "loop/loop_internal.h"

#include "base/base.h"
#include "base/rule.h"
#include "base/vec3.h"

#include <math.h>
#include <string.h>

/* N: more than any device can play; the tick limits the sum to the device's max_force. */
#define MOST_FORCE 1000.0

/* s */
#define LONGEST 3600.0

static knurl_result check_scene(const knurl_loop *loop) {
    if (!loop->shared.desc.scene) {
        return knurl_fail(KNURL_ERROR_STATE, "loop: expected one with a scene, found one with a force callback, which "
                                             "adds forces itself");
    }
    return KNURL_OK;
}

knurl_result knurl_loop_set_gain(knurl_loop *loop, double gain) {
    if (KNURL_BAD_HANDLE(loop, LOOP)) {
        return KNURL_ERROR_ARGUMENT;
    }
    if (!knurl_is_within(gain, 0.0, 1.0)) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "gain: expected 0 to 1, found %g", gain);
    }
    knurl_store_double(&loop->shared.added.gain, gain);
    return KNURL_OK;
}

knurl_result knurl_loop_set_force(knurl_loop *loop, const double force[3]) {
    KNURL_RULE(GAME, loop);
    if (KNURL_BAD_HANDLE(loop, LOOP) || KNURL_IS_NULL(force)) {
        return KNURL_ERROR_ARGUMENT;
    }
    if (!vec3_finite(force) || vec3_length(force) > MOST_FORCE) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "force: expected at most %g N, found (%g, %g, %g) N", MOST_FORCE,
                          force[0], force[1], force[2]);
    }
    const knurl_result result = check_scene(loop);
    if (!result) {
        knurl_seqlock_write(&loop->shared.added.force_sequence, loop->shared.added.force_words, force,
                            3 * sizeof *force);
    }
    return result;
}

/* A T3 vibration ends after a whole event, so that its impulse is zero. */
static uint64_t ticks_of(const knurl_wave *wave, double seconds, double rate) {
    const uint64_t ticks = (uint64_t)ceil(seconds * rate);
    const uint64_t event = wave->method == KNURL_WAVE_T3 ? (uint64_t)wave->parts[0].length : 1;
    return (ticks + event - 1) / event * event;
}

knurl_result knurl_loop_vibrate(knurl_loop *loop, int32_t method, double frequency_hz, double amplitude,
                                const double direction[3], double seconds) {
    KNURL_RULE(GAME, loop);
    if (KNURL_BAD_HANDLE(loop, LOOP) || KNURL_IS_NULL(direction)) {
        return KNURL_ERROR_ARGUMENT;
    }
    knurl_vibration cue;
    memset(&cue, 0, sizeof cue);
    vec3_copy(direction, cue.direction);
    const double length = vec3_normalise(cue.direction);
    if (!(length > 0.0 && knurl_is_finite(length))) { /* its square may overflow */
        return knurl_fail(KNURL_ERROR_ARGUMENT, "direction: expected a vector with a length, found (%g, %g, %g)",
                          direction[0], direction[1], direction[2]);
    }
    if (!knurl_is_within(frequency_hz, 0.1, 0.5 * loop->shared.desc.update_rate_hz) ||
        !knurl_is_within(amplitude, 0.0, MOST_FORCE) || !knurl_is_within(seconds, 0.0, LONGEST)) {
        return knurl_fail(KNURL_ERROR_ARGUMENT,
                          "vibration: expected 0.1 to %g Hz (half the update rate), 0 to %g N and 0 to %g s, found %g "
                          "Hz, %g N and %g s",
                          0.5 * loop->shared.desc.update_rate_hz, MOST_FORCE, LONGEST, frequency_hz, amplitude,
                          seconds);
    }
    knurl_result result = check_scene(loop);
    result =
        result ? result
               : knurl_wave_prepare(method, 1.0 / frequency_hz, amplitude, loop->shared.desc.update_rate_hz, &cue.wave);
    if (!result) {
        cue.ticks = ticks_of(&cue.wave, seconds, loop->shared.desc.update_rate_hz);
        knurl_seqlock_write(&loop->shared.added.cue_sequence, loop->shared.added.cue_words, &cue, sizeof cue);
    }
    return result;
}

/* Copies what the game wrote after `*seen`; 1 if there was anything. A write in progress is left to the next tick. */
static int take(const uint64_t *sequence, const uint64_t *words, uint64_t *seen, void *value, size_t size) {
    const uint64_t now = knurl_load_acquire(sequence);
    if (now == *seen) {
        return 0;
    }
    const int is_taken = knurl_seqlock_try_read(sequence, words, value, size);
    *seen = is_taken ? now : *seen;
    return is_taken;
}

static void take_force(knurl_loop_added *a) {
    double force[3];
    if (take(&a->force_sequence, a->force_words, &a->force_seen, force, sizeof force)) {
        vec3_copy(force, a->force);
        a->has_force = vec3_dot(force, force) > 0.0;
    }
}

static void take_cue(knurl_loop_added *a) {
    knurl_vibration cue;
    if (take(&a->cue_sequence, a->cue_words, &a->cue_seen, &cue, sizeof cue)) {
        a->cue = cue;
        a->cue_tick = 0;
    }
}

const knurl_added_force *knurl_loop_next_added(knurl_loop_added *a, knurl_added_force *sum) {
    take_force(a);
    take_cue(a);
    const int has_cue = a->cue_tick < a->cue.ticks;
    if (!a->has_force && !has_cue && a->latest == 0.0) {
        return NULL;
    }
    const double value = has_cue ? knurl_wave_value(&a->cue.wave, a->cue_tick++) : 0.0;
    vec3_madd(a->force, value, a->cue.direction, sum->force);
    sum->step = fabs(value - a->latest);
    a->latest = value;
    return sum;
}

double knurl_loop_move_gain(knurl_loop_added *a, double step) {
    a->gain_now = knurl_loop_approach(a->gain_now, knurl_load_double(&a->gain), step);
    return a->gain_now;
}

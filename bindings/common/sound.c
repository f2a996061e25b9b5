/* The sound of a session's run, shared by the session, whose haptic thread writes it, and by an engine's player, whose
 * audio thread reads it. Either may be destroyed first. SPDX-License-Identifier: MIT */
#include "parts.h"

#include <stdlib.h>

struct knurl_sound {
    uint64_t owners; /* atomic */
    knurl_audio *audio;
};

void knurl_session_take(const knurl_tick_output *output, void *user) {
    knurl_session *session = user;
    const knurl_sound *sound = __atomic_load_n(&session->sound, __ATOMIC_ACQUIRE);
    knurl_board_take(output, &session->board);
    if (sound) {
        knurl_audio_take(output, sound->audio);
    }
}

knurl_result knurl_session_get_sound(knurl_session *session, double sample_rate_hz, knurl_sound **sound) {
    if (KNURL_BAD_HANDLE(session, SESSION) || KNURL_IS_NULL(sound)) {
        return KNURL_ERROR_ARGUMENT;
    }
    knurl_result result = knurl_session_check_run(session);
    if (!result && !session->sound) {
        knurl_audio_desc desc;
        knurl_audio_desc_init(&desc, sizeof desc);
        desc.update_rate_hz = session->desc.update_rate_hz;
        desc.sample_rate_hz = sample_rate_hz;
        knurl_sound *made = malloc(sizeof *made);
        result = made ? knurl_audio_create(&desc, &made->audio)
                      : knurl_fail(KNURL_ERROR_MEMORY, "session: no memory for its sound");
        if (result || !made) {
            free(made);
        } else {
            made->owners = 1;
            __atomic_store_n(&session->sound, made, __ATOMIC_RELEASE);
        }
    }
    if (!result) {
        (void)__atomic_add_fetch(&session->sound->owners, 1, __ATOMIC_RELAXED);
        *sound = session->sound;
    }
    return result;
}

void knurl_sound_fill(knurl_sound *sound, float *samples, uint32_t count) {
    if (sound) {
        knurl_audio_fill(sound->audio, samples, count);
    }
}

knurl_result knurl_sound_get_rumble(const knurl_sound *sound, double rumble[2]) {
    return KNURL_IS_NULL(sound) ? KNURL_ERROR_ARGUMENT : knurl_audio_get_rumble(sound->audio, rumble);
}

void knurl_sound_release(knurl_sound *sound) {
    if (sound && __atomic_sub_fetch(&sound->owners, 1, __ATOMIC_ACQ_REL) == 0) {
        knurl_audio_destroy(sound->audio);
        free(sound);
    }
}

/* The sound of a session's run. SPDX-License-Identifier: MIT */
#include "session_rig.h"

#define RATE 44100.0

/* A finger 1 mm deep in ridges of 1 mm. */
static knurl_session *ridges(void) {
    surface_parts parts = surface_plane();
    knurl_session *s = make_session();
    set_grating(&parts, KNURL_METHOD_DEFAULT, 1000.0, 0.0, 2e-4);
    (void)add_surface(knurl_session_get_scene(s), &parts);
    begin_with(s, "fake", "");
    press(s, 0.0, 0.0);
    return s;
}

static knurl_sound *sound_of(knurl_session *s) {
    knurl_sound *sound = NULL;
    assert_int_equal(knurl_session_get_sound(s, RATE, &sound), KNURL_OK);
    return sound;
}

/* The loudest sample of some periods of 10 ms, with a motion of `step` (m) each. */
static float play(knurl_session *s, knurl_sound *sound, double step, int periods) {
    static double x;
    float samples[441];
    float peak = 0.0F;
    for (int i = 0; i < periods; i++) {
        x = step == 0.0 ? x : x + step > 0.04 ? 0.0 : x + step;
        if (s) {
            hold(s, x, 0.0, -0.001, 10);
        }
        knurl_sound_fill(sound, samples, 441);
        for (int k = 0; k < 441; k++) {
            assert_true(isfinite(samples[k]) && fabsf(samples[k]) <= 1.0F);
            peak = fmaxf(peak, fabsf(samples[k]));
        }
    }
    return peak;
}

TEST(a_stroke_sounds_and_a_rest_is_exact_silence) {
    SCOPED_SESSION *s = ridges();
    knurl_sound *sound = sound_of(s);
    assert_true(play(s, sound, 0.001, 100) > 0.01F); /* 100 mm/s: 100 Hz */
    (void)play(s, sound, 0.0, 60);
    assert_true(play(s, sound, 0.0, 5) == 0.0F);
    knurl_sound_release(sound);
}

TEST(a_sound_outlives_its_run_and_fades) {
    knurl_session *s = ridges();
    knurl_sound *sound = sound_of(s);
    assert_true(play(s, sound, 0.001, 100) > 0.01F);
    knurl_session_destroy(s);
    (void)play(NULL, sound, 0.0, 60);
    assert_true(play(NULL, sound, 0.0, 5) == 0.0F);
    knurl_sound_release(sound);
}

TEST(a_run_has_one_sound_and_the_next_run_another) {
    SCOPED_SESSION *s = ridges();
    knurl_sound *first = sound_of(s);
    knurl_sound *again = sound_of(s);
    assert_ptr_equal(first, again);
    knurl_sound_release(again);
    knurl_session_close(s);
    begin_with(s, "fake", "");
    knurl_sound *next = sound_of(s);
    assert_ptr_not_equal(first, next);
    knurl_sound_release(first);
    knurl_sound_release(next);
}

TEST(a_stroke_rumbles_and_a_rest_does_not) {
    SCOPED_SESSION *s = ridges();
    knurl_sound *sound = sound_of(s);
    double rumble[2];
    (void)play(s, sound, 0.0, 60);
    assert_int_equal(knurl_sound_get_rumble(sound, rumble), KNURL_OK);
    assert_true(rumble[0] < 1e-3 && rumble[1] < 1e-3);
    (void)play(s, sound, 0.001, 100); /* 100 Hz: above the crossover */
    assert_int_equal(knurl_sound_get_rumble(sound, rumble), KNURL_OK);
    assert_true(rumble[1] > 0.02 && rumble[1] > rumble[0] && rumble[1] <= 1.0);
    assert_int_equal(knurl_sound_get_rumble(NULL, rumble), KNURL_ERROR_ARGUMENT);
    knurl_sound_release(sound);
}

TEST(a_sound_needs_a_run_and_a_sample_rate) {
    knurl_session *s = make_session();
    knurl_sound *sound = NULL;
    assert_int_equal(knurl_session_get_sound(s, RATE, &sound), KNURL_ERROR_STATE);
    knurl_session_destroy(s);
    s = ridges();
    assert_int_equal(knurl_session_get_sound(s, 1000.0, &sound), KNURL_ERROR_ARGUMENT);
    check_message("sample_rate_hz");
    assert_null(sound);
    knurl_session_destroy(s);
}

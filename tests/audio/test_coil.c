/* The coil's voice and the rumble motors' envelopes against closed forms: spectrum, impulses, latency, bands.
 * SPDX-License-Identifier: MIT */
#include "ticks.h"

#include "base/vec3.h"

#define WINDOW 48000 /* samples: 1 s */

static knurl_audio *make_coil(double latency_s) {
    knurl_audio *audio = NULL;
    knurl_audio_desc desc;
    knurl_audio_desc_init(&desc, sizeof desc);
    desc.voice = KNURL_VOICE_COIL;
    desc.latency_s = latency_s;
    assert_int_equal(knurl_audio_create(&desc, &audio), KNURL_OK);
    return audio;
}

/* In contact, pushed along z by so many N. */
static knurl_tick_output pressed(double force) {
    knurl_tick_output tick = tick_off();
    tick.flags = KNURL_TICK_CONTACT;
    tick.contacts = 1;
    tick.normal[2] = 1.0;
    tick.force[2] = force;
    return tick;
}

/* Two seconds of it; the last WINDOW samples. */
static void play(knurl_audio *audio, double (*force)(int tick, double hz), double hz, float window[WINDOW]) {
    for (int k = 0; k < 2000; k++) {
        const knurl_tick_output tick = pressed(force(k, hz));
        knurl_audio_take(&tick, audio);
        memmove(window, window + A_TICK, k < 1000 ? 0 : (WINDOW - A_TICK) * sizeof *window);
        knurl_audio_fill(audio, window + WINDOW - A_TICK, A_TICK);
    }
}

static double decibels(double ratio) {
    return 20.0 * log10(ratio);
}

static double sine(int tick, double hz) {
    return 1.0 + 0.5 * sin(2.0 * PI * hz * tick / 1000.0);
}

/* The spectrum of the force of 1 kHz ticks. */
TEST(a_coil_is_flat_from_10_to_400_hz_and_hides_the_ticks) {
    static float window[WINDOW];
    static const double frequencies[] = {10.0, 30.0, 100.0, 200.0, 300.0, 350.0, 400.0, 450.0};
    for (size_t i = 0; i < COUNT_OF(frequencies); i++) {
        const double hz = frequencies[i];
        knurl_audio *audio = make_coil(0.001);
        play(audio, sine, hz, window);
        const double level = decibels(line_at(window, WINDOW, hz) / 0.5);
        const double image = decibels(line_at(window, WINDOW, 1000.0 - hz) / 0.5);
        print_message("%3.0f Hz: %+5.2f dB, image %+6.1f dB\n", hz, level, image);
        assert_true(fabs(level) < (hz < 400.0 ? 0.5 : hz > 400.0 ? 3.0 : 1.0));
        assert_true(hz > 350.0 || image < -38.0);
        knurl_audio_destroy(audio);
    }
}

static double weak(int tick, double hz) {
    return 1.0 + 1e-4 * sin(2.0 * PI * hz * tick / 1000.0);
}

/* Its steps from sample to sample are shorter than the level below which a constant force is silent. */
TEST(a_weak_and_slow_force_is_played_too) {
    static float window[WINDOW];
    knurl_audio *audio = make_coil(0.001);
    play(audio, weak, 10.0, window);
    assert_true(fabs(decibels(line_at(window, WINDOW, 10.0) / 1e-4)) < 0.5);
    knurl_audio_destroy(audio);
}

/* A square wave of 50 Hz as a method plays it: 20 ticks a cycle, whose odd lines are 4/(20 sin(pi n/20)). */
static double square(int tick, double hz) {
    return 0.8 + (tick % (int)(1000.0 / hz) < (int)(500.0 / hz) ? 0.2 : -0.2);
}

TEST(ridges_have_the_lines_of_the_sampled_height_that_is_felt) {
    static float window[WINDOW];
    knurl_audio *audio = make_coil(0.001);
    play(audio, square, 50.0, window);
    for (int n = 1; n <= 7; n += 2) {
        const double felt = 0.2 * 4.0 / (20.0 * sin(PI * n / 20.0));
        assert_true(fabs(decibels(line_at(window, WINDOW, 50.0 * n) / felt)) < 0.5);
        assert_true(line_at(window, WINDOW, 50.0 * (n + 1)) < 1e-3);
    }
    knurl_audio_destroy(audio);
}

static double touch(int tick, double at) {
    return tick < (int)at ? 0.0 : 0.5;
}

/* ms from a touch in tick 1000 to half of its height. */
static double latency(double latency_s, uint32_t block) {
    static float samples[2000 * A_TICK];
    knurl_audio *audio = make_coil(latency_s);
    int filled = 0;
    for (int k = 0; k < 2000; k++) {
        const knurl_tick_output tick = pressed(touch(k, 1000.0));
        knurl_audio_take(&tick, audio);
        if (k % (int)block == (int)block - 1) {
            knurl_audio_fill(audio, samples + filled, block * A_TICK);
            filled += (int)block * A_TICK;
        }
    }
    int first = 0;
    while (first < filled - 1 && samples[first] < 0.25f) {
        first++;
    }
    knurl_audio_destroy(audio);
    return (first + 1) / 48.0 - 1000.0 + (block - 1.0); /* a block is asked for once its last tick was taken */
}

TEST(a_touch_comes_at_most_5_ms_after_its_tick) {
    const double by_default = latency(KNURL_DEFAULT, 1);
    print_message("a touch comes %.2f ms after its tick\n", by_default);
    assert_true(by_default > 3.0 && by_default <= 5.0);
    CHECK_CLOSE(latency(0.004, 1), by_default + 3.0, 0.1);
}

TEST(a_touch_is_a_bump_as_high_as_its_force_and_ends_in_silence) {
    static float window[WINDOW];
    knurl_audio *audio = make_coil(0.001);
    float highest = 0.0f, last = 1.0f;
    for (int k = 0; k < 4000; k++) {
        const knurl_tick_output tick = pressed(touch(k, 500.0));
        knurl_audio_take(&tick, audio);
        knurl_audio_fill(audio, window, A_TICK);
        for (int i = 0; i < A_TICK; i++) {
            highest = fmaxf(highest, window[i]);
            last = window[i];
        }
    }
    assert_true(highest > 0.48f && highest < 0.58f); /* a low pass overshoots by 9 % */
    CHECK_SAME((double)last, 0.0);
    knurl_audio_destroy(audio);
}

/* A notch's force turns from -y to +y: without a contact its direction is that in which it began. */
TEST(effects_are_played_without_a_contact) {
    knurl_audio *audio = make_coil(0.001);
    float samples[A_TICK];
    double lowest = 0.0, highest = 0.0;
    for (int k = 0; k < 1000; k++) {
        knurl_tick_output tick = tick_off();
        tick.force[1] = -0.4 * sin(2.0 * PI * 50.0 * k / 1000.0);
        knurl_audio_take(&tick, audio);
        knurl_audio_fill(audio, samples, A_TICK);
        for (int i = 0; i < A_TICK; i++) {
            lowest = fmin(lowest, (double)samples[i]);
            highest = fmax(highest, (double)samples[i]);
        }
    }
    CHECK_CLOSE(highest, 0.4, 0.02);
    CHECK_CLOSE(lowest, -0.4, 0.02);
    knurl_audio_destroy(audio);
}

TEST(whatever_comes_samples_stay_within_1) {
    knurl_audio *audio = make_coil(0.0);
    float samples[7];
    for (int k = 0; k < 5000; k++) {
        knurl_tick_output tick = pressed(k % 3 ? 1e6 : -1e6);
        tick.normal[k % 2] = 1.0;
        knurl_audio_take(&tick, audio);
        for (int i = 0; i < k % 13; i++) {
            knurl_audio_fill(audio, samples, 7);
            assert_true(fabsf(samples[0]) <= 1.0f && fabsf(samples[6]) <= 1.0f);
        }
    }
    knurl_audio_destroy(audio);
}

/* --- rumble motors --- */

/* |H| of a Butterworth filter of second order, by the bilinear transform. */
static double gain(double hz, double edge, int is_high) {
    const double w = tan(PI * hz / 1000.0) / tan(PI * edge / 1000.0);
    const double low = 1.0 / sqrt(1.0 + w * w * w * w);
    return is_high ? low * w * w : low;
}

TEST(the_motors_have_the_forces_amplitude_in_their_bands) {
    static const double frequencies[] = {10.0, 20.0, 40.0, 80.0, 160.0, 250.0, 400.0};
    for (size_t i = 0; i < COUNT_OF(frequencies); i++) {
        const double hz = frequencies[i];
        double rumble[2], mean[2] = {0.0, 0.0};
        knurl_audio *audio = make_audio(0.0);
        for (int k = 0; k < 2000; k++) {
            const knurl_tick_output tick = pressed(sine(k, hz));
            knurl_audio_take(&tick, audio);
            assert_int_equal(knurl_audio_get_rumble(audio, rumble), KNURL_OK);
            mean[0] += k < 1000 ? 0.0 : rumble[0] * rumble[0] / 1000.0;
            mean[1] += k < 1000 ? 0.0 : rumble[1] * rumble[1] / 1000.0;
        }
        CHECK_CLOSE(sqrt(mean[0]), 0.5 * gain(hz, 3.0, 1) * gain(hz, 80.0, 0), 0.003);
        CHECK_CLOSE(sqrt(mean[1]), 0.5 * gain(hz, 3.0, 1) * gain(hz, 80.0, 1), 0.003);
        knurl_audio_destroy(audio);
    }
}

TEST(the_motors_stop_when_the_force_is_steady_and_are_at_most_1) {
    double rumble[2];
    knurl_audio *audio = make_audio(0.0);
    for (int k = 0; k < 3000; k++) {
        const knurl_tick_output tick = pressed(k < 1000 ? 20.0 * (k % 2) + 20.0 * (k / 25 % 2) : 3.0);
        knurl_audio_take(&tick, audio);
        assert_int_equal(knurl_audio_get_rumble(audio, rumble), KNURL_OK);
        assert_true(rumble[0] <= 1.0 && rumble[1] <= 1.0);
        assert_true(k < 900 || k >= 1000 || (rumble[0] == 1.0 && rumble[1] == 1.0));
    }
    assert_true(rumble[0] < 1e-4 && rumble[1] < 1e-4);
    knurl_audio_destroy(audio);
}

TEST(a_voice_that_is_wrong_is_refused) {
    knurl_audio *audio = NULL;
    knurl_audio_desc desc;
    double rumble[2];
    knurl_audio_desc_init(&desc, sizeof desc);
    desc.voice = 2;
    CHECK_REFUSED(knurl_audio_create(&desc, &audio), KNURL_ERROR_ARGUMENT, audio);
    check_message("voice: expected 0 (KNURL_VOICE_EAR) or 1 (KNURL_VOICE_COIL), and reserved 0, found 2, 0");
    assert_int_equal(knurl_audio_get_rumble(NULL, rumble), KNURL_ERROR_ARGUMENT);
}

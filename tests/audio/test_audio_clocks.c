/* Audio threads that are late, early, fast or slow; settings that are refused. SPDX-License-Identifier: MIT */
#include "ticks.h"

#define BLOCK 512
#define FADE  0.005 /* s */

static double loudest_of(const float *samples, int count) {
    double most = 0.0;
    for (int i = 0; i < count; i++) {
        most = fmax(most, fabs((double)samples[i]));
    }
    return most;
}

static void stroke(knurl_audio *audio, uint64_t tick) {
    const knurl_tick_output output = tick_on(0.2 * (double)tick, 0.0, 200.0);
    knurl_audio_take(&output, audio);
}

/* s from a lift, at the last queued tick, to the last sample that is heard. */
static double time_to_silence(knurl_audio *audio) {
    float samples[48];
    int last = 0;
    for (int ms = 0; ms < 100; ms++) {
        const knurl_tick_output off = tick_off();
        knurl_audio_take(&off, audio);
        knurl_audio_fill(audio, samples, 48);
        for (int i = 0; i < 48; i++) {
            last = fabsf(samples[i]) > 1e-3F ? ms * 48 + i : last;
        }
    }
    return (double)last / RATE;
}

/* An hour's drift: a sound card whose second is not the haptic thread's, in blocks. */
TEST(clocks_that_differ_by_3_in_1000_are_made_up_for) {
    static const double speeds[] = {0.997, 1.0, 1.003};
    for (size_t i = 0; i < COUNT_OF(speeds); i++) {
        float samples[BLOCK];
        uint64_t ticks = 0;
        knurl_audio *audio = make_audio(0.01);
        for (uint64_t block = 0; block < 60 * RATE / BLOCK; block++) { /* a minute */
            const double now = (double)block * BLOCK / RATE * speeds[i];
            while ((double)ticks < 1000.0 * now) {
                stroke(audio, ticks++);
            }
            knurl_audio_fill(audio, samples, BLOCK);
            if (block > 10) {
                assert_true(loudest_of(samples, BLOCK) > 0.1); /* never starved */
            }
        }
        const double late = time_to_silence(audio);
        assert_true(late > 0.0042 && late < 0.03 + 0.0042 + FADE);
        knurl_audio_destroy(audio);
    }
}

TEST(an_audio_thread_that_was_away_catches_up_at_once) {
    float samples[BLOCK];
    uint64_t ticks = 0;
    knurl_audio *audio = make_audio(0.01);
    for (int round = 0; round < 5; round++) {
        for (int k = 0; k < 5000; k++) {
            stroke(audio, ticks++);
        }
        knurl_audio_fill(audio, samples, BLOCK);
    }
    assert_true(time_to_silence(audio) < 0.01 + 0.02 + 0.002 + 0.0042 + FADE);
    knurl_audio_destroy(audio);
}

TEST(a_haptic_thread_that_stands_still_ends_in_silence_and_comes_back) {
    float samples[48];
    double loud = 0.0;
    knurl_audio *audio = make_audio(0.01);
    for (uint64_t k = 0; k < 1500; k++) {
        if (k < 500 || k >= 1000) {
            stroke(audio, k);
        }
        knurl_audio_fill(audio, samples, 48);
        loud = loudest_of(samples, 48);
        if (k >= 100 && k < 500) {
            assert_true(loud > 0.1);
        } else if (k >= 700 && k < 1000) {
            CHECK_SAME(loud, 0.0);
        }
    }
    assert_true(loud > 0.1);
    knurl_audio_destroy(audio);
}

TEST(a_sample_comes_as_late_as_the_header_says) {
    static float samples[300 * 48];
    knurl_audio *audio = make_audio(0.005);
    for (int k = 0; k < 300; k++) { /* half a cycle, from ridge to groove, at tick 200 */
        const knurl_tick_output tick = tick_on(k < 200 ? 0.0 : 0.5, 0.0, k == 200 ? 500.0 : 0.0);
        knurl_audio_take(&tick, audio);
        knurl_audio_fill(audio, samples + (ptrdiff_t)k * 48, 48);
    }
    int first = 0;
    while (first < 300 * 48 && fabsf(samples[first]) < 0.01f) {
        first++;
    }
    const double late =
        first / 48.0 - 200.0; /* ms; the edge is half a tick before its tick, and was passed on at its end */
    print_message("an edge comes %.2f ms after its tick\n", late);
    assert_true(late > 4.0 && late < 5.0 + 2.0 + 4.2);
    knurl_audio_destroy(audio);
}

TEST(settings_out_of_their_range_are_refused) {
    static const struct {
        const char *key;
        size_t offset;
        double value;
    } bad[] = {{"update_rate_hz", offsetof(knurl_audio_desc, update_rate_hz), 99.0},
               {"update_rate_hz", offsetof(knurl_audio_desc, update_rate_hz), NAN},
               {"sample_rate_hz", offsetof(knurl_audio_desc, sample_rate_hz), 7999.0},
               {"latency_s", offsetof(knurl_audio_desc, latency_s), -0.001},
               {"latency_s", offsetof(knurl_audio_desc, latency_s), INFINITY}};
    for (size_t i = 0; i < COUNT_OF(bad); i++) {
        knurl_audio *audio = NULL;
        knurl_audio_desc desc;
        knurl_audio_desc_init(&desc, sizeof desc);
        memcpy((char *)&desc + bad[i].offset, &bad[i].value, sizeof bad[i].value);
        CHECK_REFUSED(knurl_audio_create(&desc, &audio), KNURL_ERROR_ARGUMENT, audio);
        check_message(bad[i].key);
    }
}

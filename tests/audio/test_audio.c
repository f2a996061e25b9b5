/* The sound of a grating against closed forms: lines, aliases, silence, bounds, threads. SPDX-License-Identifier: MIT
 */
#include "ticks.h"

#include <pthread.h>

#define WINDOW 4800 /* samples: 0.1 s, so that lines at multiples of 10 Hz are whole cycles */
#define LEVEL  (0.5 * SWING / 0.25)

static int calls_of_heap;

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void __real_free(void *memory);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void __wrap_free(void *memory);

void *__wrap_malloc(size_t size) {
    __atomic_add_fetch(&calls_of_heap, 1, __ATOMIC_RELAXED);
    return __real_malloc(size);
}

void *__wrap_calloc(size_t count, size_t size) {
    __atomic_add_fetch(&calls_of_heap, 1, __ATOMIC_RELAXED);
    return __real_calloc(count, size);
}

void __wrap_free(void *memory) {
    __atomic_add_fetch(&calls_of_heap, 1, __ATOMIC_RELAXED);
    __real_free(memory);
}

/* A steady stroke of fx, fy cycles a second, `ticks` long; the last WINDOW samples of it. Above f_h/2 the height is
 * that of bandlimited: its sign changes every tick. */
static void play(double fx, double fy, int ticks, float window[WINDOW]) {
    knurl_audio *audio = make_audio(0.0);
    for (int k = 0; k < ticks; k++) {
        knurl_tick_output tick = tick_on(fx * k / 1000.0 + 0.1, fy * k / 1000.0, fmax(fx, fy));
        if (fx > 500.0) {
            tick.height = k % 2 ? AMPLITUDE : -AMPLITUDE;
            tick.force[2] = STIFFNESS * (DEPTH + tick.height);
        }
        knurl_audio_take(&tick, audio);
        memmove(window, window + A_TICK, (WINDOW - A_TICK) * sizeof *window);
        knurl_audio_fill(audio, window + WINDOW - A_TICK, A_TICK);
    }
    knurl_audio_destroy(audio);
}

/* The filters, as documented in the header: a high pass of first order at 20 Hz, and the mean over an eighth of a
 * sample. */
static double passed(double hz) {
    const double mean = PI * hz / (8.0 * RATE);
    return hz / sqrt(hz * hz + 400.0) * sin(mean) / mean;
}

TEST(a_line_grating_sounds_at_f_t_and_its_odd_harmonics) {
    static const double frequencies[] = {60.0, 250.0, 470.0, 990.0, 2410.0}; /* below and beyond f_h/2 */
    static float window[WINDOW];
    for (size_t i = 0; i < COUNT_OF(frequencies); i++) {
        const double f = frequencies[i];
        play(f, 0.0, 600, window);
        for (int n = 1; n * f < 16000.0 && n < 20; n++) {
            const double expected = n % 2 == 1 ? LEVEL * 4.0 / (PI * n) * passed(n * f) : 0.0;
            CHECK_CLOSE(line_at(window, WINDOW, n * f), expected, 0.002L * LEVEL);
        }
    }
}

/* Above f_h/6 bandlimited plays the fundamental alone, which swings to 4/pi A: as loud as the square wave that it is
 * of. */
TEST(a_fundamental_is_as_loud_as_its_square_wave) {
    static const double speeds[] = {180.0, 230.0, 310.0, 370.0, 440.0};
    for (size_t i = 0; i < COUNT_OF(speeds); i++) {
        static float window[WINDOW];
        const double hz = speeds[i];
        knurl_audio *audio = make_audio(0.0);
        for (int k = 0; k < 600; k++) {
            knurl_tick_output tick = tick_on(hz * k / 1000.0 + 0.1, 0.0, hz);
            tick.height = 4.0 / PI * AMPLITUDE * cos(2.0 * PI * (hz * k / 1000.0 + 0.1));
            tick.force[2] = STIFFNESS * (DEPTH + tick.height);
            knurl_audio_take(&tick, audio);
            memmove(window, window + A_TICK, (WINDOW - A_TICK) * sizeof *window);
            knurl_audio_fill(audio, window + WINDOW - A_TICK, A_TICK);
        }
        knurl_audio_destroy(audio);
        const double expected = 4.0 / PI * LEVEL * passed(hz);
        print_message("%g Hz: %.2f dB\n", hz, 20.0 * log10(line_at(window, WINDOW, hz) / expected));
        CHECK_CLOSE(line_at(window, WINDOW, hz), expected, 0.06 * expected); /* 0.5 dB */
    }
}

TEST(inharmonic_parts_are_60_db_lower) {
    static const double frequencies[] = {70.0, 250.0, 470.0, 990.0, 2410.0, 4870.0};
    static float window[WINDOW];
    for (size_t i = 0; i < COUNT_OF(frequencies); i++) {
        const double f = frequencies[i];
        double worst = 0.0;
        play(f, 0.0, 600, window);
        for (double hz = 10.0; hz < 20000.0; hz += 10.0) {
            const double n = hz / f;
            worst = floor(n) == n ? worst : fmax(worst, line_at(window, WINDOW, hz));
        }
        print_message("%4.0f Hz: %.1f dB\n", f, 20.0 * log10(worst / line_at(window, WINDOW, f)));
        assert_true(worst < 1e-3 * line_at(window, WINDOW, f));
    }
}

TEST(a_grid_sounds_at_sums_and_differences) {
    static float window[WINDOW];
    play(300.0, 70.0, 600, window);
    for (int n = 1; n <= 5; n += 2) { /* the product of two square waves, each a sum of odd cosines */
        for (int m = 1; m <= 3; m += 2) {
            const double expected = LEVEL * 8.0 / (PI * PI * n * m);
            CHECK_CLOSE(line_at(window, WINDOW, fabs(300.0 * n - 70.0 * m)), expected * passed(300.0 * n - 70.0 * m),
                        0.01L * LEVEL);
            CHECK_CLOSE(line_at(window, WINDOW, 300.0 * n + 70.0 * m), expected * passed(300.0 * n + 70.0 * m),
                        0.01L * LEVEL);
        }
    }
}

static double loudest(const float *samples, int count) {
    double most = 0.0;
    for (int i = 0; i < count; i++) {
        assert_true(isfinite(samples[i]));
        most = fmax(most, fabs((double)samples[i]));
    }
    return most;
}

TEST(without_motion_it_is_exactly_silent) {
    float samples[A_TICK];
    knurl_audio *audio = make_audio(0.0);
    knurl_audio_fill(audio, samples, A_TICK);
    CHECK_SAME(loudest(samples, A_TICK), 0.0);
    for (int k = 0; k < 2000; k++) { /* pressed in, stroked from 0.5 s on, resting from 1 s on, off at 1.5 s */
        const double stroked = k < 500 ? 0.0 : k < 1000 ? k - 500 : 500;
        knurl_tick_output tick =
            k < 1500 ? tick_on(0.2 * stroked, 0.0, k >= 500 && k < 1000 ? 200.0 : 0.0) : tick_off();
        tick.force[2] += k < 1500 ? fmin(1.0, 0.005 * k) : 0.0;
        knurl_audio_take(&tick, audio);
        knurl_audio_fill(audio, samples, A_TICK);
        const double loud = loudest(samples, A_TICK);
        if (k < 500 || k >= 1500) {
            CHECK_SAME(loud, 0.0);
        } else if (k >= 600 && k < 1000) {
            assert_true(loud > 0.5 * LEVEL);
        } else if (k >= 1150) {
            CHECK_SAME(loud, 0.0);
        }
    }
    knurl_audio_destroy(audio);
}

TEST(a_smooth_surface_is_silent_however_hard_it_is_pressed) {
    float samples[A_TICK];
    knurl_audio *audio = make_audio(0.0);
    for (int k = 0; k < 500; k++) {
        knurl_tick_output tick = tick_on(0.0, 0.0, 0.0);
        tick.height = 0.0;
        tick.force[2] = 1.0 + sin(0.3 * k);
        knurl_audio_take(&tick, audio);
        knurl_audio_fill(audio, samples, A_TICK);
        CHECK_SAME(loudest(samples, A_TICK), 0.0);
    }
    knurl_audio_destroy(audio);
}

/* A jump of uvs by 70 cycles: the wave continues. */
TEST(whole_cycles_that_no_motion_made_are_not_heard) {
    static float whole[600 * A_TICK];
    static float torn[600 * A_TICK];
    knurl_audio *a = make_audio(0.0);
    knurl_audio *b = make_audio(0.0);
    for (int k = 0; k < 600; k++) {
        const knurl_tick_output tick = tick_on(0.2371 * k, 0.0, 237.1);
        knurl_tick_output jumped = tick;
        jumped.cycles[0] -= k / 100 * 70.0;
        knurl_audio_take(&tick, a);
        knurl_audio_take(&jumped, b);
        knurl_audio_fill(a, whole + (size_t)k * A_TICK, A_TICK);
        knurl_audio_fill(b, torn + (size_t)k * A_TICK, A_TICK);
    }
    for (int i = 0; i < 600 * A_TICK; i++) {
        const int at_jump = i / A_TICK % 100 <= 3; /* the step there is a fraction of a cycle, in either direction */
        assert_true(at_jump || fabs((double)whole[i] - (double)torn[i]) < 1.5);
    }
    assert_true(loudest(torn, 600 * A_TICK) < 2.3 * LEVEL);
    knurl_audio_destroy(a);
    knurl_audio_destroy(b);
}

static double random_number(uint64_t *state) {
    static const double odd[] = {NAN, INFINITY, -INFINITY, 1e300, -1e300, 1e-300, 0.0, -0.0};
    const uint64_t bits = random_bits(state);
    const double even = (double)(int64_t)(bits >> 11) / 4503599627370496.0 - 1.0; /* -1 to 1 */
    return bits % 16 == 0 ? odd[bits / 16 % COUNT_OF(odd)] : bits % 3 == 0 ? 1000.0 * even : even;
}

/* An edge of full scale is a step of 1, and the low pass rings by a tenth of it. */
TEST(a_million_random_ticks_stay_within_the_bounds) {
    uint64_t seed = 0x9e3779b97f4a7c15u;
    float samples[A_TICK];
    double before = 0.0;
    double steepest = 0.0;
    knurl_audio *audio = make_audio(0.0);
    const int calls = __atomic_load_n(&calls_of_heap, __ATOMIC_RELAXED);
    for (int k = 0; k < 1000000; k++) {
        knurl_tick_output tick = tick_on(random_number(&seed), random_number(&seed), random_number(&seed));
        tick.height = random_number(&seed);
        tick.force[random_bits(&seed) % 3] = random_number(&seed);
        tick.flags = (uint32_t)(random_bits(&seed) % 4 > 0);
        knurl_audio_take(&tick, audio);
        if (random_bits(&seed) % 64 == 0) { /* mostly the ticks are too many, now and then too few */
            const uint32_t count = (uint32_t)(random_bits(&seed) % (A_TICK + 1));
            knurl_audio_fill(audio, samples, count);
            (void)loudest(samples, (int)count);
            for (uint32_t i = 0; i < count; i++) {
                steepest = fmax(steepest, fabs((double)samples[i] - before));
                before = (double)samples[i];
                assert_true(fabs(before) <= 1.0);
            }
        }
    }
    print_message("steepest: %.3f a sample\n", steepest);
    assert_true(steepest <= 1.1);
    assert_int_equal(__atomic_load_n(&calls_of_heap, __ATOMIC_RELAXED), calls);
    knurl_audio_destroy(audio);
}

typedef struct two_threads {
    knurl_audio *audio;
    int done; /* atomic */
} two_threads;

static void *take_ticks(void *user) {
    two_threads *both = user;
    for (int k = 0; k < 200000; k++) {
        const knurl_tick_output tick = tick_on(0.1 * k, 0.0, 100.0);
        knurl_audio_take(&tick, both->audio);
    }
    __atomic_store_n(&both->done, 1, __ATOMIC_RELEASE);
    return NULL;
}

TEST(ticks_are_handed_over_from_thread_to_thread) {
    pthread_t thread;
    float samples[256];
    two_threads both = {make_audio(0.01), 0};
    assert_int_equal(pthread_create(&thread, NULL, take_ticks, &both), 0);
    while (!__atomic_load_n(&both.done, __ATOMIC_ACQUIRE)) {
        knurl_audio_fill(both.audio, samples, 256);
        assert_true(loudest(samples, 256) <= 1.0);
    }
    assert_int_equal(pthread_join(thread, NULL), 0);
    knurl_audio_destroy(both.audio);
}

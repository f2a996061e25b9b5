/* Velocity estimators against closed forms and a brute-force FOAW.
 * SPDX-License-Identifier: MIT */
#include "motion/velocity.h"
#include "support/close.h"
#include "support/foaw.h"

#define QUANTUM 0.055e-3 /* m: the Touch's encoders */

static knurl_velocity make_velocity(int32_t method, double resolution, double rate) {
    knurl_velocity velocity;
    assert_int_equal(knurl_velocity_prepare(method, resolution, rate, &velocity), KNURL_OK);
    return velocity;
}

#define SAMPLES 100000
static int64_t walk[SAMPLES];
static int64_t held[SAMPLES];

/* Ticks between samples: a millisecond, to the nearest, from one to ten. */
static size_t stride_at(double rate) {
    return rate < 1500.0 ? 1 : rate > 10000.0 ? 10 : (size_t)floor(rate / 1000.0 + 0.5);
}

/* Feeds one axis (1024ths of a count) and compares every tick with brute force. */
static void compare_with_brute_force(const int64_t *x, size_t count, double quantum, double rate, size_t axis) {
    const size_t stride = stride_at(rate);
    const double unit = quantum * rate / (double)stride;
    knurl_velocity velocity = make_velocity(KNURL_VELOCITY_FOAW, quantum, rate);
    brute_backlash(x, held, count);
    for (size_t k = 0; k < count; k++) {
        double position[3] = {0.0, 0.0, 0.0};
        double out[3] = {9.0, 9.0, 9.0};
        const long double expected = brute_foaw(held, k, stride) * unit;
        position[axis] = (double)x[k] / (double)STEPS * quantum;
        knurl_velocity_update(&velocity, position, out);
        CHECK_CLOSE(out[axis], expected, 1e-12L * (fabsl(expected) + unit));
        CHECK_SAME(out[(axis + 1) % 3], 0.0);
        CHECK_SAME(out[(axis + 2) % 3], 0.0);
    }
}

/* Random walks whose steps change in size now and then, from rest to six counts a tick; on counts. */
static void fill_walk(uint64_t seed) {
    int64_t reach = 1;
    walk[0] = random_integer(&seed, -5000, 5000) * STEPS;
    for (size_t k = 1; k < SAMPLES; k++) {
        reach = random_integer(&seed, 0, 99) == 0 ? random_integer(&seed, 0, 6) : reach;
        walk[k] = walk[k - 1] + STEPS * random_integer(&seed, -reach, reach);
    }
}

TEST(difference_is_exact_on_lines) {
    knurl_velocity velocity = make_velocity(KNURL_VELOCITY_DIFFERENCE, 0.0, 1024.0);
    double out[3] = {9.0, 9.0, 9.0};
    for (int k = 0; k < 100; k++) { /* 0.25, -1 and 0 m/s: exact in binary */
        const double position[3] = {1.0 + k / 4096.0, -k / 1024.0, 0.125};
        knurl_velocity_update(&velocity, position, out);
        CHECK_SAME(out[0], k == 0 ? 0.0 : 0.25);
        CHECK_SAME(out[1], k == 0 ? 0.0 : -1.0);
        CHECK_SAME(out[2], 0.0);
    }
}

TEST(difference_sees_the_last_two_positions_only) {
    static const double x[] = {0.0, 1.0, 1.0, -2.0, 5.0};
    static const double expected[] = {0.0, 1000.0, 0.0, -3000.0, 7000.0};
    knurl_velocity velocity = make_velocity(KNURL_VELOCITY_DIFFERENCE, QUANTUM, 1000.0);
    double out[3];
    for (size_t k = 0; k < COUNT_OF(x); k++) {
        const double position[3] = {0.0, 0.0, x[k]};
        knurl_velocity_update(&velocity, position, out);
        CHECK_SAME(out[2], expected[k]);
    }
}

static const double rates[] = {1000.0, 2000.0, 5000.0, 10000.0};

TEST(foaw_matches_brute_force_on_random_walks) {
    for (size_t i = 0; i < COUNT_OF(rates); i++) {
        fill_walk(11 + i);
        compare_with_brute_force(walk, SAMPLES, QUANTUM, rates[i], i % 3);
    }
}

TEST(foaw_matches_brute_force_on_ramps_with_corners) {
    uint64_t seed = 21;
    double slope = 0.0;
    double x = 0.0;
    for (size_t k = 0; k < SAMPLES; k++) {
        slope = random_integer(&seed, 0, 29) == 0 ? random_between(&seed, -3.0, 3.0) : slope;
        x += slope;
        walk[k] = STEPS * (int64_t)floor(x);
    }
    compare_with_brute_force(walk, SAMPLES, QUANTUM, 4000.0, 1);
    compare_with_brute_force(walk, SAMPLES, QUANTUM, 100.0, 2); /* no stride below a tick */
    compare_with_brute_force(walk, SAMPLES, QUANTUM, 1499.0, 0);
    compare_with_brute_force(walk, SAMPLES, QUANTUM, 1500.0, 0); /* to the nearest */
    compare_with_brute_force(walk, SAMPLES, QUANTUM, 100000.0, 0);
}

TEST(foaw_matches_brute_force_between_counts) {
    uint64_t seed = 31;
    /* 1024ths of a count; a power of two as the quantum, so that they are exact */
    for (size_t k = 0; k < SAMPLES; k++) {
        walk[k] = (k == 0 ? 0 : walk[k - 1]) + random_integer(&seed, -700, 900);
    }
    compare_with_brute_force(walk, SAMPLES, 1.0 / 16384.0, 1000.0, 2);
}

TEST(foaw_accepts_a_sample_up_to_one_count_off_the_line) {
    /* half a count beyond the held value: 0, 2048, 2048, whose middle is exactly one count away; 0, 1025, 0 */
    static const int64_t on[] = {0, 2560, 2560};
    static const int64_t off[] = {0, 1537, -512};
    brute_backlash(on, held, 3);
    CHECK_SAME(brute_foaw(held, 2, 1), 1.0L);
    compare_with_brute_force(on, 3, 1.0 / 16384.0, 1000.0, 0);
    brute_backlash(off, held, 3);
    CHECK_CLOSE(brute_foaw(held, 2, 1), -1025.0L / 1024.0L, 1e-18L);
    compare_with_brute_force(off, 3, 1.0 / 16384.0, 1000.0, 0);
}

TEST(foaw_at_constant_velocity_is_within_an_eleventh_of_a_count_and_unbiased) {
    /* 15 samples fit, as positions are less than a count off; thirds of 5 are 11 samples apart. Means over ticks leave
     * the ends only, which are a count off at most. */
    uint64_t seed = 51;
    for (int i = 0; i < 200; i++) {
        const double rate = rates[i % 4];
        knurl_velocity velocity = make_velocity(KNURL_VELOCITY_FOAW, QUANTUM, rate);
        const double v = random_between(&seed, -0.5, 0.5);
        const double start = random_between(&seed, -0.05, 0.05);
        const int settled = 16 * (int)(rate / 1000.0) + (int)(QUANTUM / fabs(v) * rate) + 1;
        double sum = 0.0;
        for (int k = 0; k < settled + 2000; k++) {
            const double counts = floor((start + v * k / rate) / QUANTUM);
            const double position[3] = {counts * QUANTUM, 0.0, 0.0};
            double out[3];
            knurl_velocity_update(&velocity, position, out);
            if (k >= settled) { /* the held value follows, and has for a window */
                CHECK_CLOSE(out[0], v, QUANTUM * 1000.0 / 11.0 + 1e-12); /* 5 mm/s */
                sum += out[0];
            }
        }
        CHECK_CLOSE(sum / 2000.0, v, QUANTUM * rate / 2000.0 + 1e-12);
    }
}

/* Positions that gain speed evenly, c steps a tick a tick: the middle of a window of w samples is c w^2 / 8 from its
 * line, exactly if w is even, c (w^2 - 1) / 8 if it is odd. The velocity is that of the window's middle. */
TEST(foaw_lags_half_the_widest_window_that_a_gain_of_speed_allows) {
    static const size_t tried[] = {15, 11, 8, 6, 4, 3, 2, 1};
    static const int64_t gains[] = {2, 36, 38, 68, 70, 128, 130, 226, 228, 512, 514, 1024, 1026, 2048, 2050, 9000};
    for (size_t i = 0; i < 2 * COUNT_OF(gains); i++) {
        const double rate = i % 2 ? 10000.0 : 1000.0;
        const size_t stride = stride_at(rate);
        const size_t gain = (size_t)gains[i / 2]; /* steps a sample a sample */
        size_t w = 0;
        while (gain * (tried[w] * tried[w] / 4) > 2 * STEPS) {
            w++;
        }
        knurl_velocity velocity = make_velocity(KNURL_VELOCITY_FOAW, 1.0 / 16384.0, rate);
        for (size_t k = 0; k < 3000; k++) {
            const double tick = (double)k / (double)stride; /* a position at whole samples, a line between them */
            const double sample = floor(tick);
            const double g = (double)gain;
            const double from = 0.5 * g * sample * sample;
            const double steps = from + (tick - sample) * (0.5 * g * (sample + 1.0) * (sample + 1.0) - from);
            const double position[3] = {floor(steps) / (double)STEPS / 16384.0, 0.0, 0.0};
            double out[3];
            knurl_velocity_update(&velocity, position, out);
            if (k % stride == 0 && k > 200 * stride) {
                const double unit = 1000.0 / (double)STEPS / 16384.0; /* m/s per step a sample */
                CHECK_CLOSE(out[0], g * (sample - 0.5 * (double)tried[w]) * unit, 1e-12L);
            }
        }
    }
}

TEST(foaw_standing_still_is_exactly_zero) {
    knurl_velocity velocity = make_velocity(KNURL_VELOCITY_FOAW, QUANTUM, 1000.0);
    for (int k = 0; k < 100; k++) {
        static const double position[3] = {0.0123456789, -0.3, 17 * QUANTUM};
        double out[3] = {9.0, 9.0, 9.0};
        knurl_velocity_update(&velocity, position, out);
        for (size_t axis = 0; axis < 3; axis++) {
            CHECK_SAME(out[axis], 0.0);
        }
    }
}

TEST(foaw_of_an_encoder_that_flickers_between_two_counts_is_exactly_zero) {
    for (size_t i = 0; i < 2 * COUNT_OF(rates); i++) {
        const int64_t side = i % 2 ? 1 : -1; /* of the count it came to rest at */
        const int arrived = 200;
        const double rate = rates[i / 2];
        knurl_velocity velocity = make_velocity(KNURL_VELOCITY_FOAW, QUANTUM, rate);
        uint64_t seed = 61 + i;
        for (int k = 0; k < 5000; k++) {
            const int64_t counts = k < arrived ? k : arrived + side * random_integer(&seed, 0, 1);
            const double position[3] = {(double)counts * QUANTUM, 0.0, 0.0};
            double out[3];
            knurl_velocity_update(&velocity, position, out);
            /* the first flicker may be taken for a move; from a window after it on all is still */
            CHECK_SAME(k > arrived + 20 * (int)stride_at(rate) ? out[0] : 0.0, 0.0);
        }
    }
}

TEST(foaw_loses_one_count_at_a_reversal) {
    knurl_velocity velocity = make_velocity(KNURL_VELOCITY_FOAW, QUANTUM, 1000.0);
    int counts = 0;
    for (int k = 0; k < 100; k++) { /* up, and a rest; a count back, and a rest; another */
        counts += k < 30 ? 1 : k == 60 || k == 80 ? -1 : 0;
        const double position[3] = {counts * QUANTUM, 0.0, 0.0};
        double out[3];
        knurl_velocity_update(&velocity, position, out);
        CHECK_SAME(k >= 46 && k < 80 ? out[0] : 0.0, 0.0);
        assert_true(k < 80 || k >= 95 || out[0] < 0.0);
        CHECK_SAME(k >= 95 ? out[0] : 0.0, 0.0);
    }
}

TEST(axes_are_independent) {
    static int64_t x[3][4000];
    static int64_t behind[3][4000];
    knurl_velocity velocity = make_velocity(KNURL_VELOCITY_FOAW, QUANTUM, 1000.0);
    uint64_t seed = 71;
    for (size_t i = 0; i < 3 * COUNT_OF(x[0]); i++) {
        const size_t axis = i % 3;
        const int64_t move = random_integer(&seed, -(int64_t)axis, 2) * STEPS;
        x[axis][i / 3] = (i < 3 ? 0 : x[axis][i / 3 - 1]) + move;
    }
    for (size_t axis = 0; axis < 3; axis++) {
        brute_backlash(x[axis], behind[axis], COUNT_OF(x[0]));
    }
    for (size_t k = 0; k < COUNT_OF(x[0]); k++) {
        double position[3];
        double out[3];
        for (size_t axis = 0; axis < 3; axis++) {
            position[axis] = (double)(x[axis][k] / STEPS) * QUANTUM;
        }
        knurl_velocity_update(&velocity, position, out);
        for (size_t axis = 0; axis < 3; axis++) {
            CHECK_CLOSE(out[axis], brute_foaw(behind[axis], k, 1) * QUANTUM * 1000.0L, 1e-12L);
        }
    }
}

static const int32_t methods[] = {KNURL_VELOCITY_DIFFERENCE, KNURL_VELOCITY_FOAW};

TEST(reset_makes_the_next_position_a_first_one) {
    for (size_t i = 0; i < 2 * COUNT_OF(methods); i++) {
        const double rate = i % 2 ? 1000.0 : 3000.0;
        knurl_velocity used = make_velocity(methods[i / 2], QUANTUM, rate);
        knurl_velocity fresh = make_velocity(methods[i / 2], QUANTUM, rate);
        for (int k = 0; k < 80; k++) {
            const double position[3] = {k * k * QUANTUM, -k * QUANTUM, 5.0};
            double out[3];
            double expected[3];
            if (k == 37) {
                knurl_velocity_reset(&used);
            }
            knurl_velocity_update(&used, position, out);
            if (k >= 37) {
                knurl_velocity_update(&fresh, position, expected);
                CHECK_SAME(k == 37 ? out[0] : 0.0, 0.0);
                assert_memory_equal(out, expected, sizeof(out));
            }
        }
    }
}

/* With any content and position of the ring. */
TEST(a_reset_estimator_is_a_fresh_one_from_any_place_of_its_ring) {
    for (int before = 1; before < 70; before++) {
        uint64_t seed = (uint64_t)before;
        knurl_velocity used = make_velocity(KNURL_VELOCITY_FOAW, QUANTUM, 1000.0);
        knurl_velocity fresh = make_velocity(KNURL_VELOCITY_FOAW, QUANTUM, 1000.0);
        for (int k = 0; k < before + 70; k++) {
            const double x = k < before ? 0.0 : k * QUANTUM * (1.0 + random_between(&seed, 0.0, 0.1));
            const double position[3] = {x, -x, 0.0};
            double out[3], expected[3];
            if (k == before) {
                knurl_velocity_reset(&used);
            }
            knurl_velocity_update(&used, position, out);
            if (k >= before) {
                knurl_velocity_update(&fresh, position, expected);
                assert_memory_equal(out, expected, sizeof out);
            }
        }
    }
}

TEST(auto_is_foaw_where_the_resolution_is_known) {
    knurl_velocity known = make_velocity(KNURL_VELOCITY_AUTO, QUANTUM, 1000.0);
    knurl_velocity exact = make_velocity(KNURL_VELOCITY_AUTO, 0.0, 1000.0);
    assert_int_equal(knurl_velocity_get_state(&known)->method, KNURL_VELOCITY_FOAW);
    assert_int_equal(knurl_velocity_get_state(&exact)->method, KNURL_VELOCITY_DIFFERENCE);
}

TEST(any_finite_position_gives_a_finite_velocity) {
    static const double far[] = {0.0, 1e3, -1e6, 1e12, -1e12, 1e300, 0.0, 1e-300, -1e3};
    for (size_t i = 0; i < COUNT_OF(methods); i++) {
        knurl_velocity velocity = make_velocity(methods[i], 1e-9, 1000.0);
        for (size_t k = 0; k < 20 * COUNT_OF(far); k++) {
            const double position[3] = {far[k % COUNT_OF(far)], far[k / 20], 0.0};
            double out[3];
            knurl_velocity_update(&velocity, position, out);
            CHECK_CLOSE(out[0], 0.0, 1e305);
            CHECK_CLOSE(out[1], 0.0, 1e305);
            CHECK_SAME(out[2], 0.0);
        }
    }
}

TEST(bad_estimators_are_refused_and_nothing_is_written) {
    static const double bad[][2] = {{-QUANTUM, 1000.0}, {(double)NAN, 1000.0},  {(double)INFINITY, 1000.0},
                                    {QUANTUM, 0.0},     {QUANTUM, 1e9},         {QUANTUM, -1000.0},
                                    {QUANTUM, 0.5},     {QUANTUM, (double)NAN}, {QUANTUM, (double)INFINITY}};
    knurl_velocity velocity;
    memset(&velocity, 0xA5, sizeof(velocity));
    for (size_t i = 0; i < COUNT_OF(bad) * 3; i++) {
        CHECK_REFUSED(knurl_velocity_prepare((int32_t)(i % 3), bad[i / 3][0], bad[i / 3][1], &velocity),
                      KNURL_ERROR_ARGUMENT, velocity);
    }
    CHECK_REFUSED(knurl_velocity_prepare(KNURL_VELOCITY_FOAW, 0.0, 1000.0, &velocity), KNURL_ERROR_ARGUMENT, velocity);
    CHECK_REFUSED(knurl_velocity_prepare(3, QUANTUM, 1000.0, &velocity), KNURL_ERROR_UNKNOWN, velocity);
    CHECK_REFUSED(knurl_velocity_prepare(-1, QUANTUM, 1000.0, &velocity), KNURL_ERROR_UNKNOWN, velocity);
}

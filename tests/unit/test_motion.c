/* Velocity estimators against exact lines and a brute-force FOAW; the workspace map against its definition.
 * SPDX-License-Identifier: MIT */
#include "support/close.h"
#include "support/foaw.h"

#include <knurl/motion.h>

#define QUANTUM 0.055e-3 /* m: the Touch's encoders */

static knurl_velocity make_velocity(int32_t method, double resolution, double rate) {
    knurl_velocity velocity;
    assert_int_equal(knurl_velocity_init(method, resolution, rate, &velocity), KNURL_OK);
    return velocity;
}

/* Feeds one axis (1024ths of a count) and compares every tick with brute force. */
static void compare_with_brute_force(const int64_t *x, size_t count, double quantum, double rate, size_t axis) {
    knurl_velocity velocity = make_velocity(KNURL_VELOCITY_FOAW, quantum, rate);
    for (size_t k = 0; k < count; k++) {
        double position[3] = {0.0, 0.0, 0.0};
        double out[3] = {9.0, 9.0, 9.0};
        const long double expected = brute_foaw(x, k) * quantum * rate;
        position[axis] = (double)x[k] / (double)STEPS * quantum;
        knurl_velocity_update(&velocity, position, out);
        CHECK_CLOSE(out[axis], expected, 1e-12L * (fabsl(expected) + quantum * rate));
        CHECK_SAME(out[(axis + 1) % 3], 0.0);
        CHECK_SAME(out[(axis + 2) % 3], 0.0);
    }
}

#define SAMPLES 100000
static int64_t walk[SAMPLES];

/* Random walks whose steps change in size now and then, from rest to six counts a tick; on counts. */
static void fill_walk(uint64_t seed) {
    int64_t reach = 1;
    walk[0] = random_integer(&seed, -5000, 5000) * STEPS;
    for (size_t k = 1; k < SAMPLES; k++) {
        reach = random_integer(&seed, 0, 99) == 0 ? random_integer(&seed, 0, 6) : reach;
        walk[k] = walk[k - 1] + STEPS * random_integer(&seed, -reach, reach);
    }
}

/* Smooth motion on counts: a sum of two sinusoids, rounded down. */
static void fill_sinusoid(double counts, double period) {
    for (size_t k = 0; k < SAMPLES; k++) {
        const double t = (double)k * 6.283185307179586 / period;
        walk[k] = STEPS * (int64_t)floor(counts * (sin(t) + 0.3 * sin(3.7 * t)));
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

TEST(foaw_matches_brute_force_on_random_walks) {
    for (size_t i = 0; i < 3; i++) {
        fill_walk(11 + i);
        compare_with_brute_force(walk, SAMPLES, QUANTUM, 1000.0, i);
    }
}

TEST(foaw_matches_brute_force_on_sinusoids) {
    static const double counts[] = {3.0, 40.0, 900.0};
    static const double periods[] = {50.0, 333.0, 1000.0, 7919.0};
    for (size_t i = 0; i < COUNT_OF(counts) * COUNT_OF(periods); i++) {
        fill_sinusoid(counts[i / 4], periods[i % 4]);
        compare_with_brute_force(walk, 20000, QUANTUM, 1000.0, i % 3);
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
}

TEST(foaw_matches_brute_force_between_counts) {
    uint64_t seed = 31;
    /* 1024ths of a count; a power of two as the quantum, so that they are exact */
    for (size_t k = 0; k < SAMPLES; k++) {
        walk[k] = (k == 0 ? 0 : walk[k - 1]) + random_integer(&seed, -700, 900);
    }
    compare_with_brute_force(walk, SAMPLES, 1.0 / 16384.0, 1000.0, 2);
}

TEST(foaw_takes_a_sample_one_count_off_the_line_and_none_further) {
    static const int64_t on[] = {0, 2, 2}; /* the middle is exactly one count off: the slope over two ticks */
    static const int64_t off[] = {0, 1025, 0};
    int64_t x[3];
    for (size_t i = 0; i < 3; i++) {
        x[i] = on[i] * STEPS;
    }
    CHECK_SAME(brute_foaw(x, 2), 1.0L);
    compare_with_brute_force(x, 3, QUANTUM, 1000.0, 0);
    CHECK_CLOSE(brute_foaw(off, 2), -1025.0L / 1024.0L, 1e-18L);
    compare_with_brute_force(off, 3, 1.0 / 16384.0, 1000.0, 0);
}

TEST(foaw_takes_the_widest_window_though_a_narrower_one_fails) {
    /* "stop at the first failure" differs: the two newest ticks do not fit, all three do */
    uint64_t seed = 41;
    int found = 0;
    while (found < 100) {
        int64_t x[4];
        for (size_t i = 0; i < 4; i++) {
            x[i] = STEPS * random_integer(&seed, -4, 4);
        }
        const int64_t two = 2 * x[2] - x[3] - x[1];
        const long double wide = (long double)(x[3] - x[0]) / (3.0L * STEPS);
        if ((two > 2 * STEPS || -two > 2 * STEPS) && brute_foaw(x, 3) == wide) {
            compare_with_brute_force(x, 4, QUANTUM, 1000.0, 0);
            found++;
        }
    }
}

TEST(foaw_at_constant_velocity_is_within_a_fifteenth_of_a_count) {
    uint64_t seed = 51;
    for (int i = 0; i < 200; i++) {
        knurl_velocity velocity = make_velocity(KNURL_VELOCITY_FOAW, QUANTUM, 1000.0);
        const double v = random_between(&seed, -0.5, 0.5);
        const double start = random_between(&seed, -0.05, 0.05);
        for (int k = 0; k < 200; k++) {
            const double counts = floor((start + v * k / 1000.0) / QUANTUM);
            const double position[3] = {counts * QUANTUM, 0.0, 0.0};
            double out[3];
            knurl_velocity_update(&velocity, position, out);
            if (k >= 15) { /* 3.7 mm/s from the 16th sample on */
                CHECK_CLOSE(out[0], v, QUANTUM * 1000.0 / 15.0 + 1e-12);
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

TEST(foaw_of_an_encoder_that_flickers_is_what_brute_force_says) {
    uint64_t seed = 61;
    for (size_t k = 0; k < SAMPLES; k++) {
        walk[k] = STEPS * (k < 1000 ? (int64_t)(k % 2) : random_integer(&seed, 0, 1));
    }
    CHECK_CLOSE(brute_foaw(walk, 501), 1.0L / 15.0L, 1e-18L); /* all of it is within one count: 15 ticks */
    compare_with_brute_force(walk, SAMPLES, QUANTUM, 1000.0, 0);
}

TEST(axes_are_independent) {
    static int64_t x[3][4000];
    knurl_velocity velocity = make_velocity(KNURL_VELOCITY_FOAW, QUANTUM, 1000.0);
    uint64_t seed = 71;
    for (size_t k = 0; k < COUNT_OF(x[0]); k++) {
        double position[3];
        double out[3];
        for (size_t axis = 0; axis < 3; axis++) {
            const int64_t move = random_integer(&seed, -(int64_t)axis, 2) * STEPS;
            x[axis][k] = (k == 0 ? 0 : x[axis][k - 1]) + move;
            position[axis] = (double)(x[axis][k] / STEPS) * QUANTUM;
        }
        knurl_velocity_update(&velocity, position, out);
        for (size_t axis = 0; axis < 3; axis++) {
            CHECK_CLOSE(out[axis], brute_foaw(x[axis], k) * QUANTUM * 1000.0L, 1e-12L);
        }
    }
}

TEST(reset_makes_the_next_position_a_first_one) {
    static const int32_t methods[] = {KNURL_VELOCITY_DIFFERENCE, KNURL_VELOCITY_FOAW};
    for (size_t i = 0; i < COUNT_OF(methods); i++) {
        knurl_velocity used = make_velocity(methods[i], QUANTUM, 1000.0);
        knurl_velocity fresh = make_velocity(methods[i], QUANTUM, 1000.0);
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

TEST(auto_is_foaw_where_the_resolution_is_known) {
    assert_int_equal(make_velocity(KNURL_VELOCITY_AUTO, QUANTUM, 1000.0).method, KNURL_VELOCITY_FOAW);
    assert_int_equal(make_velocity(KNURL_VELOCITY_AUTO, 0.0, 1000.0).method, KNURL_VELOCITY_DIFFERENCE);
}

TEST(any_finite_position_gives_a_finite_velocity) {
    static const double far[] = {0.0, 1e3, -1e6, 1e12, -1e12, 1e300, 0.0, 1e-300, -1e3};
    static const int32_t methods[] = {KNURL_VELOCITY_DIFFERENCE, KNURL_VELOCITY_FOAW};
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
        CHECK_REFUSED(knurl_velocity_init((int32_t)(i % 3), bad[i / 3][0], bad[i / 3][1], &velocity),
                      KNURL_ERROR_ARGUMENT, velocity);
    }
    CHECK_REFUSED(knurl_velocity_init(KNURL_VELOCITY_FOAW, 0.0, 1000.0, &velocity), KNURL_ERROR_ARGUMENT, velocity);
    CHECK_REFUSED(knurl_velocity_init(3, QUANTUM, 1000.0, &velocity), KNURL_ERROR_UNKNOWN, velocity);
    CHECK_REFUSED(knurl_velocity_init(-1, QUANTUM, 1000.0, &velocity), KNURL_ERROR_UNKNOWN, velocity);
}

/* A quarter turn about z: device x is scene y, device y is scene -x; twice the size, off the origin. */
static knurl_workspace quarter_turn(void) {
    const knurl_workspace workspace = {{10.0, 20.0, 30.0}, {0, -1, 0, 1, 0, 0, 0, 0, 1}, 2.0, 0.0};
    return workspace;
}

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* A random rotation (from a unit quaternion), scale and origin. */
static knurl_workspace random_workspace(uint64_t *seed) {
    knurl_workspace w;
    double q[4];
    double norm = 0.0;
    for (size_t i = 0; i < 4; i++) {
        q[i] = random_between(seed, -1.0, 1.0);
        norm += q[i] * q[i];
    }
    knurl_workspace_init(&w);
    for (size_t i = 0; i < 3; i++) {
        w.origin[i] = random_between(seed, -2.0, 2.0);
        for (size_t j = 0; j < 3; j++) { /* (s^2 - v.v) I + 2 v v^T + 2 s [v]x, over the norm */
            const double cross = (j + 3 - i) % 3 == 1 ? -q[(i + 2) % 3] : q[(i + 1) % 3];
            const double same = q[3] * q[3] - dot(q, q);
            w.rotation[3 * i + j] = (2.0 * q[i] * q[j] + (i == j ? same : 2.0 * q[3] * cross)) / norm;
        }
    }
    w.scale = random_between(seed, 0.1, 10.0);
    assert_int_equal(knurl_workspace_check(&w), KNURL_OK);
    return w;
}

TEST(workspace_init_changes_nothing) {
    static const double p[3] = {1.0, -2.0, 3.0};
    knurl_workspace workspace;
    double out[3];
    memset(&workspace, 0xA5, sizeof(workspace));
    knurl_workspace_init(&workspace);
    assert_int_equal(knurl_workspace_check(&workspace), KNURL_OK);
    knurl_workspace_to_scene(&workspace, p, out);
    assert_memory_equal(out, p, sizeof(p));
    knurl_workspace_to_device(&workspace, p, out);
    assert_memory_equal(out, p, sizeof(p));
}

static void check_vector(const double actual[3], double x, double y, double z) {
    CHECK_CLOSE(actual[0], x, 1e-15L);
    CHECK_CLOSE(actual[1], y, 1e-15L);
    CHECK_CLOSE(actual[2], z, 1e-15L);
}

TEST(workspace_turns_scales_and_shifts_as_defined) {
    static const double p[3] = {1.0, 2.0, 3.0};
    const knurl_workspace workspace = quarter_turn();
    double out[3];
    assert_int_equal(knurl_workspace_check(&workspace), KNURL_OK);
    knurl_workspace_to_scene(&workspace, p, out);
    check_vector(out, 10.0 - 4.0, 20.0 + 2.0, 30.0 + 6.0);
    knurl_workspace_velocity_to_scene(&workspace, p, out);
    check_vector(out, -4.0, 2.0, 6.0);
    knurl_workspace_vector_to_device(&workspace, p, out);
    check_vector(out, 2.0, -1.0, 3.0); /* the length is kept */
    knurl_workspace_to_device(&workspace, p, out);
    check_vector(out, (2.0 - 20.0) / 2.0, -(1.0 - 10.0) / 2.0, (3.0 - 30.0) / 2.0);
}

TEST(workspace_there_and_back_is_where_it_began) {
    uint64_t seed = 81;
    for (int i = 0; i < 2000; i++) {
        const knurl_workspace w = random_workspace(&seed);
        double p[3];
        double scene[3];
        double out[3];
        for (size_t j = 0; j < 3; j++) {
            p[j] = random_between(&seed, -0.2, 0.2);
        }
        knurl_workspace_to_scene(&w, p, scene);
        knurl_workspace_to_device(&w, scene, out);
        for (size_t j = 0; j < 3; j++) {
            CHECK_CLOSE(out[j], p[j], 1e-13L);
        }
    }
}

TEST(scene_power_is_scale_times_device_power) {
    uint64_t seed = 91;
    for (int i = 0; i < 2000; i++) {
        const knurl_workspace w = random_workspace(&seed);
        double v[3];
        double f[3];
        double scene_v[3];
        double device_f[3];
        for (size_t j = 0; j < 3; j++) {
            v[j] = random_between(&seed, -0.5, 0.5);
            f[j] = random_between(&seed, -3.0, 3.0);
        }
        knurl_workspace_velocity_to_scene(&w, v, scene_v);
        knurl_workspace_vector_to_device(&w, f, device_f);
        CHECK_CLOSE(dot(f, scene_v), w.scale * dot(device_f, v), 1e-12L);
        CHECK_CLOSE(dot(device_f, device_f), dot(f, f), 1e-12L);
        CHECK_CLOSE(dot(scene_v, scene_v), w.scale * w.scale * dot(v, v), 1e-12L);
    }
}

TEST(workspace_check_refuses_what_is_not_finite_or_has_no_size) {
    static const double bad[] = {(double)NAN, (double)INFINITY, -(double)INFINITY};
    static const double no_size[] = {0.0, -1.0, -0.0};
    for (size_t i = 0; i < 13 * COUNT_OF(bad); i++) { /* each number: origin, rotation, scale */
        knurl_workspace w = quarter_turn();
        double *numbers[] = {&w.origin[0], &w.rotation[0], &w.scale};
        const size_t n = i / 3;
        *(n < 3 ? numbers[0] + n : n < 12 ? numbers[1] + (n - 3) : numbers[2]) = bad[i % 3];
        CHECK_REFUSED(knurl_workspace_check(&w), KNURL_ERROR_ARGUMENT, w);
    }
    for (size_t i = 0; i < COUNT_OF(no_size); i++) {
        knurl_workspace w = quarter_turn();
        w.scale = no_size[i];
        CHECK_REFUSED(knurl_workspace_check(&w), KNURL_ERROR_ARGUMENT, w);
    }
}

TEST(workspace_check_refuses_mirrors_shears_and_stretches) {
    static const double bad[][9] = {
        {1, 0, 0, 0, 1, 0, 0, 0, -1},  {0, 1, 0, 1, 0, 0, 0, 0, 1},    {-1, 0, 0, 0, -1, 0, 0, 0, -1},
        {0, 0, 0, 0, 0, 0, 0, 0, 0},   {2, 0, 0, 0, 2, 0, 0, 0, 2},    {2, 0, 0, 0, 0.5, 0, 0, 0, 1},
        {1, 0.1, 0, 0, 1, 0, 0, 0, 1}, {1, 0, 1e-5, 0, 1, 0, 0, 0, 1}, {1, 0, 0, 0, 1 + 1e-5, 0, 0, 0, 1},
        {1, 0, 0, 1, 0, 0, 0, 0, 1},   {1, 0, 0, 1e-5, 1, 0, 0, 0, 1}, {1 + 1e-5, 0, 0, 0, 1 / (1 + 1e-5), 0, 0, 0, 1}};
    for (size_t i = 0; i < COUNT_OF(bad); i++) {
        knurl_workspace w = quarter_turn();
        memcpy(w.rotation, bad[i], sizeof(bad[i]));
        CHECK_REFUSED(knurl_workspace_check(&w), KNURL_ERROR_ARGUMENT, w);
    }
    for (size_t i = 0; i < 9; i++) { /* rounding is no reason to refuse */
        knurl_workspace w = quarter_turn();
        w.rotation[i] += 1e-8;
        assert_int_equal(knurl_workspace_check(&w), KNURL_OK);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(difference_is_exact_on_lines),
        cmocka_unit_test(difference_sees_the_last_two_positions_only),
        cmocka_unit_test(foaw_matches_brute_force_on_random_walks),
        cmocka_unit_test(foaw_matches_brute_force_on_sinusoids),
        cmocka_unit_test(foaw_matches_brute_force_on_ramps_with_corners),
        cmocka_unit_test(foaw_matches_brute_force_between_counts),
        cmocka_unit_test(foaw_takes_a_sample_one_count_off_the_line_and_none_further),
        cmocka_unit_test(foaw_takes_the_widest_window_though_a_narrower_one_fails),
        cmocka_unit_test(foaw_at_constant_velocity_is_within_a_fifteenth_of_a_count),
        cmocka_unit_test(foaw_standing_still_is_exactly_zero),
        cmocka_unit_test(foaw_of_an_encoder_that_flickers_is_what_brute_force_says),
        cmocka_unit_test(axes_are_independent),
        cmocka_unit_test(reset_makes_the_next_position_a_first_one),
        cmocka_unit_test(auto_is_foaw_where_the_resolution_is_known),
        cmocka_unit_test(any_finite_position_gives_a_finite_velocity),
        cmocka_unit_test(bad_estimators_are_refused_and_nothing_is_written),
        cmocka_unit_test(workspace_init_changes_nothing),
        cmocka_unit_test(workspace_turns_scales_and_shifts_as_defined),
        cmocka_unit_test(workspace_there_and_back_is_where_it_began),
        cmocka_unit_test(scene_power_is_scale_times_device_power),
        cmocka_unit_test(workspace_check_refuses_what_is_not_finite_or_has_no_size),
        cmocka_unit_test(workspace_check_refuses_mirrors_shears_and_stretches),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

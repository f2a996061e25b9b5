/* The workspace map against its definition. SPDX-License-Identifier: MIT */
#include "support/close.h"

#include <knurl/motion.h>

/* A quarter turn about z: device x is scene y, device y is scene -x; twice the size, off the origin. */
static knurl_workspace quarter_turn(void) {
    const knurl_workspace workspace = {{10.0, 20.0, 30.0}, {0, -1, 0, 1, 0, 0, 0, 0, 1}, 2.0, {0.0}};
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
    knurl_workspace_set_identity(&w);
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
    knurl_workspace_set_identity(&workspace);
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
        knurl_workspace w = random_workspace(&seed);
        double v[3];
        double f[3];
        double scene_v[3];
        double device_f[3];
        for (size_t j = 0; j < 3; j++) {
            v[j] = random_between(&seed, -0.5, 0.5);
            f[j] = random_between(&seed, -3.0, 3.0);
        }
        memset(w.origin, 0, sizeof w.origin); /* so that a velocity is mapped as a position */
        knurl_workspace_to_scene(&w, v, scene_v);
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

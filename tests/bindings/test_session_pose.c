/* An engine's matrix as a position, a rotation and the baked rest. SPDX-License-Identifier: MIT */
#include "session.h"

#include "support/close.h"

/* Columns a, b, c in floats, as engines keep them, about (1, 2, 3). */
static void make_matrix(const double a[3], const double b[3], const double c[3], double matrix[12]) {
    for (int i = 0; i < 3; i++) {
        matrix[4 * i] = (double)(float)a[i];
        matrix[4 * i + 1] = (double)(float)b[i];
        matrix[4 * i + 2] = (double)(float)c[i];
        matrix[4 * i + 3] = (double)(i + 1);
    }
}

static double determinant(const double m[9]) {
    return m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) + m[2] * (m[3] * m[7] - m[4] * m[6]);
}

static knurl_session_pose check_split(const double matrix[12]) {
    knurl_session_pose p;
    assert_int_equal(knurl_session_split_pose(matrix, &p), 1);
    CHECK_CLOSE(determinant(p.rotation), 1.0, 1e-12);
    for (int i = 0; i < 3; i++) {
        CHECK_SAME(p.position[i], matrix[4 * i + 3]);
        for (int j = 0; j < 3; j++) {
            double product = 0.0;
            double square = 0.0;
            for (int k = 0; k < 3; k++) {
                product += p.rotation[3 * i + k] * p.rest[3 * k + j];
                square += p.rotation[3 * i + k] * p.rotation[3 * j + k];
            }
            CHECK_CLOSE(product, matrix[4 * i + j], 2e-5);
            CHECK_CLOSE(square, i == j ? 1.0 : 0.0, 1e-12);
        }
    }
    const double *q = p.quaternion; /* its matrix, element by element */
    const double turned[9] = {1.0 - 2.0 * (q[1] * q[1] + q[2] * q[2]), 2.0 * (q[0] * q[1] - q[3] * q[2]),
                              2.0 * (q[0] * q[2] + q[3] * q[1]),       2.0 * (q[0] * q[1] + q[3] * q[2]),
                              1.0 - 2.0 * (q[0] * q[0] + q[2] * q[2]), 2.0 * (q[1] * q[2] - q[3] * q[0]),
                              2.0 * (q[0] * q[2] - q[3] * q[1]),       2.0 * (q[1] * q[2] + q[3] * q[0]),
                              1.0 - 2.0 * (q[0] * q[0] + q[1] * q[1])};
    for (int i = 0; i < 9; i++) {
        CHECK_CLOSE(turned[i], p.rotation[i], 1e-12);
    }
    return p;
}

TEST(a_matrix_is_its_rotation_times_the_rest) {
    const double s = sin(0.7);
    const double c = cos(0.7);
    const double cases[][3][3] = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},         {{c, 0, -s}, {0, 1, 0}, {s, 0, c}},
                                  {{-1, 0, 0}, {0, 1, 0}, {0, 0, -1}},       {{1, 0, 0}, {0, -1, 0}, {0, 0, -1}},
                                  {{-1, 0, 0}, {0, -1, 0}, {0, 0, 1}},       {{2, 0, 0}, {0, 3, 0}, {0, 0, 0.5}},
                                  {{1, 0, 0}, {0, 1, 0}, {0, 0, -1}},        {{1, 0, 0}, {0.5, 1, 0}, {0.2, -0.3, 1}},
                                  {{-c, 0, s}, {0, 2, 0}, {3 * s, 0, 3 * c}}};
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        double matrix[12];
        make_matrix(cases[i][0], cases[i][1], cases[i][2], matrix);
        (void)check_split(matrix);
    }
}

TEST(random_matrices_are_split) {
    uint64_t random = 8;
    for (int i = 0; i < 1000; i++) {
        double matrix[12];
        double left[9];
        for (int j = 0; j < 12; j++) {
            matrix[j] = random_between(&random, -2.0, 2.0);
            left[j / 4 * 3 + (j % 4 < 3 ? j % 4 : 2)] = matrix[j % 4 < 3 ? j : j - 1];
        }
        if (fabs(determinant(left)) > 0.01) {
            const knurl_session_pose p = check_split(matrix);
            CHECK_CLOSE(determinant(p.rest), determinant(left), 1e-9); /* so its sign shows a mirror */
        }
    }
}

TEST(scales_and_shears_are_the_rest) {
    const double a[3] = {2, 0, 0};
    const double b[3] = {0.5, 3, 0};
    const double c[3] = {0, 0, -0.25};
    const double expected[9] = {2, 0.5, 0, 0, 3, 0, 0, 0, -0.25};
    double matrix[12];
    make_matrix(a, b, c, matrix);
    const knurl_session_pose p = check_split(matrix);
    for (int i = 0; i < 9; i++) {
        CHECK_SAME(p.rest[i], expected[i]);
    }
}

TEST(a_rotation_in_floats_leaves_exactly_nothing) {
    static const double one[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    for (int i = 0; i < 100; i++) {
        const double s = sin(0.1 * i);
        const double c = cos(0.1 * i);
        const double x[3] = {c, 0, -s};
        const double y[3] = {0, 1, 0};
        const double z[3] = {s, 0, c};
        double matrix[12];
        make_matrix(x, y, z, matrix);
        const knurl_session_pose p = check_split(matrix);
        assert_memory_equal(p.rest, one, sizeof one);
    }
}

TEST(a_flat_or_non_finite_transform_leaves_the_pose_unchanged) {
    static const double x[3] = {1, 0, 0};
    static const double y[3] = {0, 1, 0};
    static const double z[3] = {0, 0, 1};
    static const double none[3] = {0, 0, 0};
    static const double nan[3] = {NAN, 0, 0};
    static const double infinite[3] = {0, 0, INFINITY};
    const double *cases[][3] = {{none, none, none}, {x, x, y},    {x, y, none}, {x, y, x},
                                {x, none, z},       {none, y, z}, {nan, y, x},  {x, y, infinite}};
    for (size_t i = 0; i <= COUNT_OF(cases); i++) {
        knurl_session_pose p;
        unsigned char before[sizeof p];
        double matrix[12];
        const int is_last = i == COUNT_OF(cases);
        make_matrix(is_last ? x : cases[i][0], is_last ? y : cases[i][1], is_last ? z : cases[i][2], matrix);
        matrix[3] = is_last ? INFINITY : 0.0;
        memset(&p, 0x5a, sizeof p);
        memcpy(before, &p, sizeof p);
        assert_int_equal(knurl_session_split_pose(matrix, &p), 0);
        assert_memory_equal(&p, before, sizeof p);
    }
}

TEST(rests_are_the_same_to_a_floats_rounding) {
    const double a[9] = {100, 0, 0, 0, 1, 0, 0, 0, 1};
    double b[9];
    memcpy(b, a, sizeof a);
    assert_int_equal(knurl_session_same_rest(a, b), 1);
    b[4] = 1.0 + 0.9e-3; /* of the longest: 1e-5 */
    assert_int_equal(knurl_session_same_rest(a, b), 1);
    b[4] = 1.0 + 1.1e-3;
    assert_int_equal(knurl_session_same_rest(a, b), 0);
}

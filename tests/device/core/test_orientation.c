/* Orientations of styli, from matrices and from devices. SPDX-License-Identifier: MIT */
#include "home.h"

#include "device/quaternion.h"

/* The columns of the rotation by a unit quaternion: how it turns the three axes, v + 2 w (u x v) + 2 u x (u x v). */
static void turn_axes(const double q[4], double columns[3][3]) {
    for (int axis = 0; axis < 3; axis++) {
        double once[3];
        double twice[3];
        double v[3] = {0.0, 0.0, 0.0};
        v[axis] = 1.0;
        vec3_cross(q, v, once);
        vec3_cross(q, once, twice);
        for (int i = 0; i < 3; i++) {
            columns[axis][i] = v[i] + 2.0 * q[3] * once[i] + 2.0 * twice[i];
        }
    }
}

TEST(the_quaternion_of_a_rotation_by_any_angle_is_found) {
    uint64_t random = 1;
    for (int turn = 0; turn < 10000; turn++) {
        double q[4];
        double found[4];
        double columns[3][3];
        double square = 0.0;
        for (int i = 0; i < 4; i++) { /* every eighth is a half turn, every other eighth about an axis */
            q[i] = (turn % 8 == 0 && i == 3) || (turn % 8 == 1 && i < 2) ? 0.0 : random_between(&random, -1.0, 1.0);
            square += q[i] * q[i];
        }
        for (int i = 0; i < 4; i++) {
            q[i] /= sqrt(square);
        }
        turn_axes(q, columns);
        quaternion_from_axes(columns[0], columns[1], columns[2], found);
        const double dot = q[0] * found[0] + q[1] * found[1] + q[2] * found[2] + q[3] * found[3];
        CHECK_CLOSE(fabs(dot), 1.0, 1e-12); /* q and -q are one rotation */
    }
}

TEST(a_matrix_that_is_no_rotation_has_no_quaternion) {
    static const double none[3];
    static const double x[3] = {1.0, 0.0, 0.0};
    static const double y[3] = {0.0, 1.0, 0.0};
    static const double mirrored[3] = {0.0, 0.0, -1.0};
    const double broken[3] = {(double)NAN, 0.0, 1.0};
    double q[4];
    const double *const last[] = {none, x, mirrored, broken};
    for (size_t i = 0; i < COUNT_OF(last); i++) {
        quaternion_from_axes(x, y, last[i], q);
        assert_true(q[0] == 0.0 && q[1] == 0.0 && q[2] == 0.0 && q[3] == 0.0);
    }
}

static double told[4];

static knurl_result read_turned(void *user, knurl_device_sample *sample) {
    (void)user;
    memset(sample->position, 0, sizeof sample->position);
    sample->buttons = 0;
    if (told[3] != 2.0) { /* otherwise it is like a device without orientation */
        memcpy(sample->orientation, told, sizeof told);
    }
    return KNURL_OK;
}

static void check_told(double x, double y, double z, double w, int is_told) {
    home h;
    SCOPED_DEVICE *device = NULL;
    knurl_device_sample sample;
    memset(&h, 0, sizeof h);
    memset(&sample, 0xff, sizeof sample);
    knurl_device_functions f = home_functions(&h, 0);
    f.read = read_turned;
    assert_int_equal(knurl_device_open_functions(&f, &device), KNURL_OK);
    told[0] = x;
    told[1] = y;
    told[2] = z;
    told[3] = w;
    assert_int_equal(knurl_device_read(device, &sample), KNURL_OK);
    const knurl_device_status status = device_status(device);
    for (int i = 0; i < 4; i++) {
        assert_true(sample.orientation[i] == (is_told ? told[i] : 0.0));
        assert_true(status.orientation[i] == sample.orientation[i]);
    }
}

TEST(an_own_device_may_have_an_orientation_and_invalid_ones_are_ignored) {
    check_told(0.5, 0.5, 0.5, 0.5, 1);
    check_told(0.0, 0.0, 0.0, 2.0, 0);
    check_told(0.0, 0.0, 3.0, 1.0, 0);
    check_told((double)NAN, 0.0, 0.0, 1.0, 0);
}

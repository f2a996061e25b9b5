/* The parts of the Godot binding that need no engine: the mouse's filter, how transforms are split, what the haptic
 * thread leaves for the game. SPDX-License-Identifier: MIT */
#include "board.h"
#include "mouse.h"
#include "pose.h"

#include "support/close.h"

#define PI 3.14159265358979323846

/* --- the device "mouse" --- */

typedef struct rig {
    mouse m;
    knurl_device *device;
} rig;

static void open_rig(rig *r, double rate) {
    memset(r, 0, sizeof *r);
    assert_int_equal(mouse_open(&r->m, &r->device), KNURL_OK);
    assert_int_equal(knurl_device_start(r->device, rate), KNURL_OK);
}

static void move_x(rig *r, double x) {
    const double position[3] = {x, 0.0, 0.0};
    mouse_move(&r->m, position);
}

static double read_x(rig *r) {
    knurl_device_sample sample;
    assert_int_equal(knurl_device_read(r->device, &sample), KNURL_OK);
    return sample.position[0];
}

TEST(a_mouse_that_never_moved_gives_no_position) {
    rig r;
    knurl_device_sample sample;
    open_rig(&r, 1000.0);
    assert_int_equal(knurl_device_read(r.device, &sample), KNURL_ERROR_DEVICE_NOT_READY);
    move_x(&r, 0.3);
    CHECK_SAME(read_x(&r), 0.3);
    knurl_device_close(r.device);
}

TEST(a_steady_motion_lags_25_ms_behind) {
    rig r;
    double x = 0.0;
    open_rig(&r, 1000.0);
    for (int tick = 0; tick < 1000; tick++) {
        move_x(&r, 1e-4 * tick); /* 0.1 m/s */
        x = read_x(&r);
    }
    CHECK_CLOSE(0.0999 - x, 0.1 * 0.025, 0.1 * 0.0011); /* the target stands still within a tick */
    knurl_device_close(r.device);
}

/* Steps at 60 Hz are impulses of velocity: 1 + 2 cos(w t) + ...; two poles at a = 80/s pass a^2 / (a^2 + w^2). */
TEST(steps_at_60_hz_become_a_velocity_with_9_percent_of_ripple) {
    enum { PERIOD = 100, PERIODS = 60 };
    const double rate = 60.0 * PERIOD;
    const double w = 2.0 * PI * 60.0;
    double cosine = 0.0;
    double sine = 0.0;
    double first = 0.0;
    rig r;
    open_rig(&r, rate);
    double before = 0.0;
    for (int tick = 0; tick < 2 * PERIODS * PERIOD; tick++) {
        move_x(&r, 0.1 / 60.0 * (tick / PERIOD)); /* 0.1 m/s */
        const double x = read_x(&r);
        if (tick == PERIODS * PERIOD) {
            first = before;
        }
        if (tick >= PERIODS * PERIOD) {
            cosine += (x - before) * cos(2.0 * PI * tick / PERIOD);
            sine += (x - before) * sin(2.0 * PI * tick / PERIOD);
        }
        before = x;
    }
    const double mean = before - first;
    CHECK_CLOSE(mean, 0.1, 1e-6);
    CHECK_CLOSE(2.0 * hypot(cosine, sine) / mean, 2.0 * 80.0 * 80.0 / (80.0 * 80.0 + w * w), 0.002);
    knurl_device_close(r.device);
}

TEST(a_leap_becomes_a_move_that_devices_positions_are_believed_at) {
    rig r;
    knurl_device_event event;
    open_rig(&r, 1000.0);
    move_x(&r, 0.0);
    double x = read_x(&r);
    move_x(&r, 2.0);
    for (int tick = 0; tick < 1000; tick++) {
        const double next = read_x(&r);
        assert_true(next >= x && next - x <= 5.0 / 1000.0 * 1.000001);
        x = next;
    }
    CHECK_CLOSE(x, 2.0, 1e-6);
    assert_int_equal(knurl_device_next_event(r.device, &event), 0);
    knurl_device_close(r.device);
}

/* --- transforms --- */

/* Columns a, b, c as the engine keeps them. */
static gd_transform basis(const double a[3], const double b[3], const double c[3]) {
    gd_transform t;
    for (int i = 0; i < 3; i++) {
        t.basis[i][0] = (float)a[i];
        t.basis[i][1] = (float)b[i];
        t.basis[i][2] = (float)c[i];
        t.origin[i] = (float)i;
    }
    return t;
}

static double determinant(const double m[9]) {
    return m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) + m[2] * (m[3] * m[7] - m[4] * m[6]);
}

static void check_split(const gd_transform *t) {
    pose p;
    assert_true(pose_split(t, &p));
    CHECK_CLOSE(determinant(p.rotation), 1.0, 1e-12);
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            double product = 0.0;
            double square = 0.0;
            for (int k = 0; k < 3; k++) {
                product += p.rotation[3 * i + k] * p.rest[3 * k + j];
                square += p.rotation[3 * i + k] * p.rotation[3 * j + k];
            }
            CHECK_CLOSE(product, (double)t->basis[i][j], 2e-5);
            CHECK_CLOSE(square, i == j ? 1.0 : 0.0, 1e-12);
        }
    }
    const double *q = p.quaternion; /* its first column is what it makes of x */
    CHECK_CLOSE(1.0 - 2.0 * (q[1] * q[1] + q[2] * q[2]), p.rotation[0], 1e-12);
    CHECK_CLOSE(2.0 * (q[0] * q[1] + q[3] * q[2]), p.rotation[3], 1e-12);
    CHECK_CLOSE(2.0 * (q[0] * q[2] - q[3] * q[1]), p.rotation[6], 1e-12);
    CHECK_CLOSE(2.0 * (q[1] * q[2] + q[3] * q[0]), p.rotation[7], 1e-12);
}

TEST(a_transform_is_its_rotation_times_the_rest) {
    const double s = sin(0.7);
    const double c = cos(0.7);
    const double cases[][3][3] = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},         {{c, 0, -s}, {0, 1, 0}, {s, 0, c}},
                                  {{-1, 0, 0}, {0, 1, 0}, {0, 0, -1}},       {{1, 0, 0}, {0, -1, 0}, {0, 0, -1}},
                                  {{-1, 0, 0}, {0, -1, 0}, {0, 0, 1}},       {{2, 0, 0}, {0, 3, 0}, {0, 0, 0.5}},
                                  {{1, 0, 0}, {0, 1, 0}, {0, 0, -1}},        {{1, 0, 0}, {0.5, 1, 0}, {0.2, -0.3, 1}},
                                  {{-c, 0, s}, {0, 2, 0}, {3 * s, 0, 3 * c}}};
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        const gd_transform t = basis(cases[i][0], cases[i][1], cases[i][2]);
        check_split(&t);
    }
}

TEST(a_rotation_in_floats_leaves_exactly_nothing) {
    static const double one[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    for (int i = 0; i < 100; i++) {
        const double s = sin(0.1 * i);
        const double c = cos(0.1 * i);
        const double a[3] = {c, 0, -s};
        const double b[3] = {0, 1, 0};
        const double d[3] = {s, 0, c};
        const gd_transform t = basis(a, b, d);
        pose p;
        assert_true(pose_split(&t, &p));
        assert_memory_equal(p.rest, one, sizeof one);
    }
}

TEST(what_has_no_volume_or_is_no_number_is_refused) {
    const double none[3] = {0, 0, 0};
    const double x[3] = {1, 0, 0};
    const double y[3] = {0, 1, 0};
    const double nan[3] = {NAN, 0, 0};
    const gd_transform cases[] = {basis(none, none, none), basis(x, x, y), basis(x, y, none), basis(x, y, x),
                                  basis(nan, y, x)};
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        pose p;
        assert_false(pose_split(&cases[i], &p));
    }
}

/* --- the board --- */

static void take(board *b, uint64_t tick, knurl_surface felt) {
    knurl_tick_output output;
    memset(&output, 0, sizeof output);
    output.tick = tick;
    output.height = (double)tick;
    output.normal[1] = 1.0;
    output.force[1] = 2.0 * (double)tick;
    output.surface = felt;
    board_take(&output, b);
}

TEST(the_history_is_of_the_latest_ticks_oldest_first) {
    static board b;
    static float rows[2 * BOARD_TICKS];
    memset(&b, 0, sizeof b);
    assert_int_equal(board_history(&b, 10, rows), 0);
    for (uint64_t tick = 0; tick < 3; tick++) {
        take(&b, tick, 0);
    }
    assert_int_equal(board_history(&b, 10, rows), 3);
    assert_int_equal(board_history(&b, 2, rows), 2);
    CHECK_SAME((double)rows[0], 1.0);
    CHECK_SAME((double)rows[3], 4.0);
    for (uint64_t tick = 3; tick < BOARD_TICKS + 100; tick++) {
        take(&b, tick, 0);
    }
    const uint32_t count = board_history(&b, BOARD_TICKS, rows);
    assert_in_range(count, BOARD_TICKS - 1, BOARD_TICKS);
    for (uint32_t i = 0; i < count; i++) {
        CHECK_SAME((double)rows[2 * i], (double)(BOARD_TICKS + 100 - count + i));
    }
}

TEST(changes_of_what_is_touched_are_told_once_each) {
    static board b;
    knurl_surface met[BOARD_CHANGES];
    board_tick now;
    memset(&b, 0, sizeof b);
    take(&b, 0, 7);
    take(&b, 1, 7);
    take(&b, 2, 0);
    take(&b, 3, 9);
    assert_int_equal(board_changes(&b, met), 3);
    assert_true(met[0] == 7 && met[1] == 0 && met[2] == 9);
    assert_int_equal(board_changes(&b, met), 0);
    board_read(&b, &now);
    assert_true(now.surface == 9 && now.tick == 4);
    for (uint64_t tick = 4; tick < 204; tick++) {
        take(&b, tick, tick);
    }
    assert_int_equal(board_changes(&b, met), BOARD_CHANGES);
    assert_true(met[BOARD_CHANGES - 1] == 203);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_mouse_that_never_moved_gives_no_position),
        cmocka_unit_test(a_steady_motion_lags_25_ms_behind),
        cmocka_unit_test(steps_at_60_hz_become_a_velocity_with_9_percent_of_ripple),
        cmocka_unit_test(a_leap_becomes_a_move_that_devices_positions_are_believed_at),
        cmocka_unit_test(a_transform_is_its_rotation_times_the_rest),
        cmocka_unit_test(a_rotation_in_floats_leaves_exactly_nothing),
        cmocka_unit_test(what_has_no_volume_or_is_no_number_is_refused),
        cmocka_unit_test(the_history_is_of_the_latest_ticks_oldest_first),
        cmocka_unit_test(changes_of_what_is_touched_are_told_once_each),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* Motion of the fake device's hand: strokes as specified in device.h, its tremor, its seeds.
 * SPDX-License-Identifier: MIT */
#include "support/close.h"
#include "support/fake.h"

#include "device/fake/hand.h"

#define DT   0.001 /* s */
#define DOWN 250   /* ticks: "comes down within 0.25 s and then moves" */

/* A stroke on a surface in a general pose: the tests use its own frame. */
static const double centre[3] = {0.01, -0.02, 0.005};
static const double along_x[3] = {0.6, 0.0, 0.8};
static const double outward[3] = {0.0, 1.0, 0.0};
static const double along_y[3] = {0.8, 0.0, -0.6}; /* normal x x */

static knurl_stroke_desc make_stroke(int32_t stroke) {
    knurl_stroke_desc desc;
    knurl_stroke_desc_init(&desc, sizeof desc);
    desc.stroke = stroke;
    memcpy(desc.centre, centre, sizeof centre);
    memcpy(desc.x, along_x, sizeof along_x);
    memcpy(desc.normal, outward, sizeof outward);
    return desc;
}

static knurl_hand make_hand(const knurl_stroke_desc *desc, double tremor) {
    knurl_stroke_desc checked = *desc;
    knurl_hand hand;
    assert_int_equal(knurl_stroke_check(&checked), KNURL_OK);
    knurl_hand_init(&hand, &checked, tremor, 1);
    return hand;
}

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* The target at a tick in the stroke's frame: along x, along y, and height over the surface. */
static void target_at(knurl_hand *hand, int tick, double out[3]) {
    double target[3];
    knurl_hand_target(hand, tick * DT, DT, target);
    const double offset[3] = {target[0] - centre[0], target[1] - centre[1], target[2] - centre[2]};
    out[0] = dot(offset, along_x);
    out[1] = dot(offset, along_y);
    out[2] = dot(offset, outward);
}

TEST(every_stroke_starts_5_mm_above_and_comes_down_on_the_spot_within_a_quarter_second) {
    for (int32_t stroke = KNURL_STROKE_LINE; stroke <= KNURL_STROKE_REST; stroke++) {
        const knurl_stroke_desc desc = make_stroke(stroke);
        knurl_hand hand = make_hand(&desc, 0.0);
        double at[3];
        double height = 0.005;
        for (int tick = 0; tick <= DOWN; tick++) {
            target_at(&hand, tick, at);
            CHECK_CLOSE(at[0], 0.0, 1e-15);
            CHECK_CLOSE(at[1], 0.0, 1e-15);
            assert_true(at[2] <= height + 1e-15);
            height = at[2];
            assert_true(tick > 0 || fabs(height - 0.005) < 1e-15);
        }
        CHECK_CLOSE(height, -0.001, 1e-15);
    }
}

/* Turns are rounded: full speed in the middle, at half of it 2 % before an end, and nowhere more. The middle half of
 * the path must be steady within 2 %. Speeds are differences over a tick. */
TEST(a_line_goes_back_and_forth_at_its_speed_over_its_reach) {
    knurl_stroke_desc desc = make_stroke(KNURL_STROKE_LINE);
    desc.speed = 0.2;
    desc.reach[0] = 0.03;
    knurl_hand hand = make_hand(&desc, 0.0);
    double at[3];
    double last = 0.0;
    double low = 0.0;
    double high = 0.0;
    int crossings = 0;
    target_at(&hand, DOWN, at);
    for (int tick = DOWN + 1; tick <= DOWN + 2000; tick++) {
        target_at(&hand, tick, at);
        const double speed = fabs(at[0] - last) * RATE;
        assert_true(speed <= 0.2 + 1e-9);
        assert_true(speed >= 0.196 || fabs(at[0]) > 0.5 * 0.03);
        assert_true(speed >= 0.1 || fabs(at[0]) > 0.97 * 0.03);
        assert_true(speed <= 0.1 || fabs(at[0]) < 0.99 * 0.03);
        CHECK_CLOSE(at[1], 0.0, 1e-15);
        CHECK_CLOSE(at[2], -0.001, 1e-15);
        crossings += last != 0.0 && (last > 0.0) != (at[0] > 0.0);
        low = fmin(low, at[0]);
        high = fmax(high, at[0]);
        last = at[0];
    }
    CHECK_CLOSE(high, 0.03, 0.03 * 0.005);
    CHECK_CLOSE(low, -0.03, 0.03 * 0.005);
    assert_int_equal(crossings, 5); /* 0.4 m of path, some 0.067 m from middle to middle */
}

TEST(a_sweep_goes_from_standing_to_250_mm_a_second_and_back_within_its_period) {
    knurl_stroke_desc desc = make_stroke(KNURL_STROKE_SWEEP);
    desc.reach[0] = 1.0; /* the whole period, 0.625 m, is in the straight part of a path of 1 m */
    knurl_hand hand = make_hand(&desc, 0.0);
    double at[3];
    double last = 0.0;
    double fastest = 0.0;
    target_at(&hand, DOWN, at);
    for (int tick = DOWN + 1; tick <= DOWN + 5000; tick++) {
        target_at(&hand, tick, at);
        const double t = (tick - DOWN - 0.5) * DT; /* the difference's middle */
        const double speed = (at[0] - last) * RATE;
        const double wanted = 0.25 * (1.0 - fabs(t - 2.5) / 2.5);
        const double tolerance = 0.25 * DT / 2.5 + 1e-12; /* the speed's change in a tick */
        assert_true(speed <= wanted + tolerance);
        assert_true(speed >= (at[0] < 0.5 ? 0.98 : 0.95) * wanted - tolerance);
        fastest = fmax(fastest, speed);
        CHECK_CLOSE(at[2], -0.001, 1e-15);
        last = at[0];
    }
    CHECK_CLOSE(fastest, 0.25, 0.01 * 0.25);
    CHECK_CLOSE(at[0], 0.5 * 0.25 * 5.0, 0.02 * 0.625); /* the area under the triangle */
}

TEST(a_sweep_turns_within_its_reach_and_starts_anew_after_its_period) {
    knurl_stroke_desc desc = make_stroke(KNURL_STROKE_SWEEP);
    desc.reach[0] = 0.04;
    desc.period = 2.0;
    knurl_hand hand = make_hand(&desc, 0.0);
    double at[3];
    double last = 0.0;
    double low = 0.0;
    double high = 0.0;
    double way[3] = {0.0, 0.0, 0.0};
    target_at(&hand, DOWN, at);
    for (int tick = DOWN + 1; tick <= DOWN + 6000; tick++) {
        target_at(&hand, tick, at);
        const double speed = fabs(at[0] - last) * RATE;
        const double u = fmod((tick - DOWN - 0.5) * DT, 2.0);
        assert_true(speed <= 0.25 * (1.0 - fabs(u - 1.0)) + 0.25 * DT);
        way[(tick - DOWN - 1) / 2000] += fabs(at[0] - last);
        low = fmin(low, at[0]);
        high = fmax(high, at[0]);
        last = at[0];
    }
    CHECK_CLOSE(high, 0.04, 0.04 * 0.005);
    CHECK_CLOSE(low, -0.04, 0.04 * 0.005);
    for (int period = 0; period < 3; period++) { /* 0.25 m each, less at the turns */
        assert_true(way[period] > 0.2 && way[period] <= 0.25 + 1e-9);
    }
}

TEST(a_circle_goes_round_at_its_speed_and_at_the_smaller_reach) {
    for (int turned = 0; turned < 2; turned++) {
        knurl_stroke_desc desc = make_stroke(KNURL_STROKE_CIRCLE);
        desc.reach[0] = turned ? 0.02 : 0.05;
        desc.reach[1] = turned ? 0.05 : 0.02;
        knurl_hand hand = make_hand(&desc, 0.0);
        double at[3];
        double last[3] = {0.0, 0.0, 0.0};
        int quadrants = 0;
        for (int tick = 0; tick <= DOWN + 6000; tick++) {
            target_at(&hand, tick, at);
            assert_true(hypot(at[0], at[1]) <= 0.02 + 1e-12);
            if (tick > DOWN + 1300) { /* out on the circle after a turn of 2 pi 0.02 m / 0.1 m/s = 1.26 s */
                CHECK_CLOSE(hypot(at[0], at[1]), 0.02, 1e-12);
                CHECK_CLOSE(hypot(at[0] - last[0], at[1] - last[1]) * RATE, 0.1, 1e-6); /* a chord */
                CHECK_CLOSE(at[2], -0.001, 1e-15);
                quadrants |= 1 << ((at[0] > 0.0) + 2 * (at[1] > 0.0));
            }
            memcpy(last, at, sizeof last);
        }
        assert_int_equal(quadrants, 15); /* every direction */
    }
}

TEST(a_press_goes_from_its_depth_to_three_times_it_and_back_on_the_spot) {
    knurl_stroke_desc desc = make_stroke(KNURL_STROKE_PRESS);
    desc.depth = 0.002;
    desc.period = 2.0;
    knurl_hand hand = make_hand(&desc, 0.0);
    double at[3];
    for (int tick = 0; tick <= DOWN + 4000; tick++) {
        target_at(&hand, tick, at);
        CHECK_CLOSE(at[0], 0.0, 1e-15);
        CHECK_CLOSE(at[1], 0.0, 1e-15);
        if (tick >= DOWN) {
            assert_true(at[2] <= -0.002 + 1e-12 && at[2] >= -0.006 - 1e-12);
            if ((tick - DOWN) % 2000 == 0) {
                CHECK_CLOSE(at[2], -0.002, 1e-9);
            } else if ((tick - DOWN) % 1000 == 0) {
                CHECK_CLOSE(at[2], -0.006, 1e-9);
            }
        }
    }
}

TEST(a_rest_stands_at_its_depth) {
    const knurl_stroke_desc desc = make_stroke(KNURL_STROKE_REST);
    knurl_hand hand = make_hand(&desc, 0.0);
    double at[3];
    for (int tick = 0; tick <= 5000; tick++) {
        target_at(&hand, tick, at);
        CHECK_CLOSE(at[0], 0.0, 1e-15);
        CHECK_CLOSE(at[1], 0.0, 1e-15);
        assert_true(tick < DOWN || fabs(at[2] + 0.001) < 1e-15);
    }
}

/* An oscillator of 10 Hz and damping 0.3 forgets within 50 ms: 200 s hold some 2,000 independent samples, whose rms is
 * within 5 % of the true one in all but one of a million. */
TEST(the_tremors_rms_is_near_its_setting_on_every_axis_at_every_rate) {
    static const double rates[] = {500.0, 1000.0, 4000.0};
    for (size_t i = 0; i < COUNT_OF(rates); i++) {
        const knurl_stroke_desc desc = make_stroke(KNURL_STROKE_REST);
        knurl_hand still = make_hand(&desc, 0.0);
        knurl_hand shaking = make_hand(&desc, 20e-6);
        double sum[3] = {0.0, 0.0, 0.0};
        const int ticks = (int)(200.0 * rates[i]);
        for (int tick = 0; tick < ticks; tick++) {
            double quiet[3];
            double target[3];
            knurl_hand_target(&still, tick / rates[i], 1.0 / rates[i], quiet);
            knurl_hand_target(&shaking, tick / rates[i], 1.0 / rates[i], target);
            for (int axis = 0; axis < 3; axis++) {
                sum[axis] += (target[axis] - quiet[axis]) * (target[axis] - quiet[axis]);
            }
        }
        for (int axis = 0; axis < 3; axis++) {
            CHECK_CLOSE(sqrt(sum[axis] / ticks), 20e-6, 0.05 * 20e-6);
        }
    }
}

TEST(strokes_have_the_names_that_the_tool_takes) {
    static const char *const names[] = {"line", "sweep", "circle", "press", "rest"};
    static const char *const strange[] = {"Line", "lin", "lines", "", "zigzag"};
    int32_t stroke = 0;
    for (int32_t i = 0; i < 5; i++) {
        assert_int_equal(knurl_stroke_from_name(names[i], &stroke), KNURL_OK);
        assert_int_equal(stroke, KNURL_STROKE_LINE + i);
    }
    for (size_t i = 0; i < COUNT_OF(strange); i++) {
        CHECK_REFUSED(knurl_stroke_from_name(strange[i], &stroke), KNURL_ERROR_UNKNOWN, stroke);
    }
    for (int32_t i = 0; i < 5; i++) {
        assert_non_null(strstr(knurl_error_message(), names[i]));
    }
    assert_non_null(strstr(knurl_error_message(), "zigzag"));
    CHECK_REFUSED(knurl_stroke_from_name(NULL, &stroke), KNURL_ERROR_ARGUMENT, stroke);
}

TEST(a_bad_stroke_is_refused) {
    SCOPED_DEVICE *device = open_device("fake");
    for (int i = 0; i < 18; i++) {
        knurl_stroke_desc desc = make_stroke(KNURL_STROKE_SWEEP);
        double *const fields[] = {&desc.centre[0], &desc.x[1],  &desc.normal[2], &desc.reach[0],
                                  &desc.reach[1],  &desc.depth, &desc.speed,     &desc.period};
        if (i < 8) {
            *fields[i] = NAN;
        } else if (i < 16) {
            *fields[i - 8] = i == 13 ? HUGE_VAL : -HUGE_VAL;
        } else {
            desc.stroke = i == 16 ? 0 : 6;
        }
        CHECK_REFUSED(knurl_fake_set_stroke(device, &desc), KNURL_ERROR_ARGUMENT, desc);
    }
    knurl_stroke_desc skew = make_stroke(KNURL_STROKE_LINE);
    memcpy(skew.normal, along_x, sizeof along_x);
    CHECK_REFUSED(knurl_fake_set_stroke(device, &skew), KNURL_ERROR_ARGUMENT, skew);
}

/* --- through the device --- */

static knurl_device *start_device(const char *uri, int32_t stroke) {
    knurl_stroke_desc desc;
    knurl_device *device = open_device(uri);
    knurl_stroke_desc_init(&desc, sizeof desc);
    desc.stroke = stroke;
    assert_int_equal(knurl_fake_set_stroke(device, &desc), KNURL_OK);
    assert_int_equal(knurl_device_start(device, RATE), KNURL_OK);
    return device;
}

TEST(a_stroke_holds_from_the_next_start) {
    knurl_stroke_desc desc;
    SCOPED_DEVICE *device = open_device("fake:?tremor=0&resolution=0");
    knurl_stroke_desc_init(&desc, sizeof desc);
    desc.centre[1] = 0.02;
    assert_int_equal(knurl_fake_set_stroke(device, &desc), KNURL_OK);
    CHECK_CLOSE(read_one(device).position[1], 0.005, 1e-9);
    assert_int_equal(knurl_device_start(device, RATE), KNURL_OK);
    CHECK_CLOSE(read_one(device).position[1], 0.025, 1e-9);
}

/* The device trails its hand by the friction that holds it back, (Fc + b v)/k, and by the integrator's v h. */
TEST(the_device_follows_the_hand) {
    knurl_stroke_desc desc;
    knurl_stroke_desc_init(&desc, sizeof desc);
    knurl_hand hand = make_hand(&desc, 0.0);
    SCOPED_DEVICE *device = start_device("fake:?tremor=0&resolution=0", KNURL_STROKE_LINE);
    for (int tick = 0; tick <= 600; tick++) { /* to 35 of 50 mm, well before the turn */
        double target[3];
        knurl_hand_target(&hand, tick * DT, DT, target);
        const knurl_device_sample sample = read_one(device);
        if (tick > 400) {
            CHECK_CLOSE(sample.position[0], target[0], (0.26 + 0.5 * 0.1) / 700.0 + 0.1 * DT);
            CHECK_CLOSE(sample.position[1], -0.001, 0.26 / 700.0);
            CHECK_CLOSE(sample.position[2], 0.0, 1e-12);
        }
    }
}

static int same_sample(const knurl_device_sample *a, const knurl_device_sample *b) {
    return a->position[0] == b->position[0] && a->position[1] == b->position[1] && a->position[2] == b->position[2] &&
           a->buttons == b->buttons;
}

static int same_positions(const char *one_uri, const char *other_uri) {
    knurl_device *one = start_device(one_uri, KNURL_STROKE_CIRCLE);
    knurl_device *other = start_device(other_uri, KNURL_STROKE_CIRCLE);
    int same = 1;
    for (int tick = 0; tick < 2000; tick++) {
        const knurl_device_sample a = read_one(one);
        const knurl_device_sample b = read_one(other);
        const double force[3] = {-10.0 * a.position[0], 0.1, -10.0 * a.position[2]};
        assert_int_equal(knurl_device_write(one, force), KNURL_OK);
        assert_int_equal(knurl_device_write(other, force), KNURL_OK);
        same = same && same_sample(&a, &b);
    }
    knurl_device_close(one);
    knurl_device_close(other);
    return same;
}

TEST(the_same_seed_gives_the_same_positions_and_another_one_others) {
    assert_true(same_positions("fake:?seed=7", "fake:?seed=7"));
    assert_true(same_positions("fake", "fake:?seed=1"));
    assert_false(same_positions("fake:?seed=7", "fake:?seed=8"));
    assert_false(same_positions("fake:?seed=0", "fake:?seed=1"));
    assert_true(same_positions("fake:?tremor=0&seed=7", "fake:?tremor=0&seed=8")); /* the seed is the tremor's alone */
}

TEST(starting_again_plays_the_same_once_more) {
    static const double force[3] = {0.5, 0.5, 0.0};
    static knurl_device_sample first[1000];
    SCOPED_DEVICE *device = start_device("fake", KNURL_STROKE_LINE);
    for (int turn = 0; turn < 2; turn++) {
        assert_int_equal(knurl_device_start(device, RATE), KNURL_OK);
        for (size_t tick = 0; tick < COUNT_OF(first); tick++) {
            const knurl_device_sample sample = read_one(device);
            assert_true(turn == 0 || same_sample(&first[tick], &sample));
            first[tick] = sample;
            assert_int_equal(knurl_device_write(device, force), KNURL_OK);
        }
    }
}

/* The default hand is stable at every rate that a loop allows: 0.26 N of friction over 700 N/m is the tolerance of its
 * rest position.
 */
TEST(the_default_hand_comes_to_rest_at_its_target_at_every_rate) {
    static const double rates[] = {100.0, 300.0, 1000.0, 3000.0, 10000.0};
    for (size_t i = 0; i < COUNT_OF(rates); i++) {
        SCOPED_DEVICE *device = start_device("fake:?tremor=0&resolution=0", KNURL_STROKE_REST);
        assert_int_equal(knurl_device_start(device, rates[i]), KNURL_OK);
        double last = 0.0;
        for (int tick = 0; tick < (int)(2.0 * rates[i]); tick++) {
            last = read_one(device).position[1];
        }
        CHECK_CLOSE(last, -0.001, 0.26 / 700.0 + 1e-9);
        CHECK_CLOSE(read_one(device).position[1], last, 1e-12);
    }
}

/* --- paths --- */

/* A quarter of a ring of 0.1 m round z, its normals outward. */
static void write_arc(double rows[][6], uint32_t count) {
    for (uint32_t i = 0; i < count; i++) {
        const double a = 0.5 * 3.141592653589793 * i / (count - 1);
        const double row[6] = {0.1 * cos(a), 0.1 * sin(a), 0.0, cos(a), sin(a), 0.0};
        memcpy(rows[i], row, sizeof row);
    }
}

TEST(a_stroke_along_a_path_keeps_its_depth_and_stays_on_it) {
    static double rows[91][6];
    knurl_stroke_desc stroke;
    double least = 10.0;
    double most = -10.0;
    knurl_device *device =
        open_device("fake:?preset=ideal&hand_stiffness=10000&hand_damping=50"); /* follows its hand */
    write_arc(rows, COUNT_OF(rows));
    knurl_stroke_desc_init(&stroke, sizeof stroke);
    stroke.path = rows[0];
    stroke.path_rows = COUNT_OF(rows);
    assert_int_equal(knurl_fake_set_stroke(device, &stroke), KNURL_OK);
    memset(rows, 0xff, sizeof rows); /* it was copied */
    assert_int_equal(knurl_device_start(device, RATE), KNURL_OK);
    for (int k = 0; k < 5000; k++) {
        const knurl_device_sample s = read_one(device);
        const double angle = atan2(s.position[1], s.position[0]);
        if (k == 0) { /* 5 mm above its middle */
            CHECK_CLOSE(hypot(s.position[0], s.position[1]), 0.105, 1e-6);
            CHECK_CLOSE(angle, 0.25 * 3.141592653589793, 1e-6);
        } else if (k > 300) {
            CHECK_CLOSE(hypot(s.position[0], s.position[1]), 0.099, 2e-4);
        }
        least = fmin(least, angle);
        most = fmax(most, angle);
    }
    CHECK_CLOSE(least, 0.0, 0.02);
    CHECK_CLOSE(most, 0.5 * 3.141592653589793, 0.02);
    knurl_device_close(device);
}

TEST(wrong_paths_are_refused) {
    static double rows[3][6];
    static double still[3][6];
    knurl_stroke_desc stroke;
    SCOPED_DEVICE *device = open_device("fake");
    write_arc(rows, 3);
    for (uint32_t i = 0; i < 3; i++) {
        memcpy(still[i], rows[0], sizeof rows[0]);
    }
    for (int wrong = 0; wrong < 6; wrong++) {
        knurl_stroke_desc_init(&stroke, sizeof stroke);
        stroke.path = wrong == 0 ? NULL : wrong == 1 ? still[0] : rows[0];
        stroke.path_rows = wrong == 2 ? 1 : wrong == 3 ? KNURL_PATH_ROWS_MAX + 1 : 3;
        stroke.stroke = wrong == 4 ? KNURL_STROKE_CIRCLE : KNURL_STROKE_LINE;
        stroke.path_loop = 2;
        rows[1][4] = wrong == 5 ? NAN : rows[1][4];
        assert_int_equal(knurl_fake_set_stroke(device, &stroke), KNURL_ERROR_ARGUMENT);
        check_message("stroke.path");
    }
}

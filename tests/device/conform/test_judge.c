/* The judge of samples/conform detects each broken promise, and reports nothing otherwise. The device has 5 N and 1
 * kHz: forces may grow by 1 N per tick, and ramps take 20 ticks. SPDX-License-Identifier: MIT */
#include "judge.h"

#include "support/close.h"

static judge j; /* reset by each test */

static knurl_tick_output tick; /* the next tick */

static void begin(void) {
    knurl_device_info info;
    knurl_device_info_init(&info, sizeof info);
    info.max_force = 5.0;
    info.continuous_force = 2.0;
    info.heat_time = 1.0;
    memset(&j, 0, sizeof j);
    memset(&tick, 0, sizeof tick);
    j.sees_writes = 1;
    judge_begin(&j, &info, 1000.0, 0.019, 0.0);
}

static void write_force(double x, double y) {
    const double force[3] = {x, y, 0.0};
    judge_write(&j, force);
}

/* A tick with a force along x, y, with `count` contacts of surface 7, the deepest, at a height. */
static void tick_on(double x, double y, uint32_t count, double height) {
    const knurl_hip_contact contacts[2] = {{.surface = 7}, {.surface = 7}};
    write_force(x, y);
    tick.device_force[0] = x;
    tick.device_force[1] = y;
    tick.surface = count > 0 ? 7 : 0;
    tick.height = height;
    judge_tick(&j, &tick, contacts, count);
    tick.tick++;
}

static void tick_of(double x, double y) {
    tick_on(x, y, 0, 0.0);
}

/* From the present force along x to another, as fast as allowed. */
static void grow(double to) {
    while (j.force[0] < to) {
        tick_of(fmin(to, j.force[0] + 1.0), 0.0);
    }
}

/* The number of breaches of `promise`; -1 if another one is broken. */
static int only(int promise) {
    for (int i = 0; i < JUDGE_COUNT; i++) {
        if (i != promise && j.breaches[i].count > 0) {
            print_error("%s\n", judge_promises[i].sentence);
            return -1;
        }
    }
    return (int)j.breaches[promise].count;
}

#define KEPT() assert_int_equal(only(JUDGE_FINITE), 0)

TEST(forces_that_grow_slowly_and_fall_at_once_pass) {
    begin();
    grow(5.0);
    tick_of(2.0, 0.0);
    tick_of(0.0, 0.0);
    tick_of(-1.0, 0.0);
    tick_of(0.0, 0.9); /* in the other direction, from zero */
    KEPT();
}

TEST(a_force_that_is_no_number_or_too_strong_is_found) {
    begin();
    tick_of((double)NAN, 0.0);
    assert_int_equal(j.breaches[JUDGE_FINITE].count, 1);
    begin();
    grow(5.0);
    tick_of(5.1, 0.0);
    assert_int_equal(only(JUDGE_BOUNDED), 1);
}

TEST(a_force_that_turns_or_grows_faster_than_the_slew_limit_is_found) {
    static const double next[][2] = {{4.1, 0.0}, {-1.1, 0.0}, {0.0, 1.1}, {3.0, 1.1}, {1.0, -1.1}};
    static const double kept[][2] = {{3.9, 0.0}, {-0.9, 0.0}, {0.0, 0.9}, {3.0, 0.9}, {1.0, -0.9}};
    for (size_t i = 0; i < COUNT_OF(next); i++) {
        begin();
        grow(3.0);
        tick_of(next[i][0], next[i][1]);
        assert_int_equal(only(JUDGE_SLEW), 1);
        begin();
        grow(3.0);
        tick_of(kept[i][0], kept[i][1]);
        KEPT();
    }
}

TEST(a_textures_own_step_is_allowed_and_no_more) {
    knurl_material_desc material;
    knurl_material_desc_init(&material, sizeof material);
    material.method = KNURL_METHOD_S1;
    material.stiffness = 1000.0;
    material.amplitude = 0.0005; /* steps of 1 N */
    for (int over = 0; over < 2; over++) {
        begin();
        judge_surface_is(&j, 7, &material);
        for (int k = 0; k < 4; k++) {
            tick_on(0.5, 0.0, 1, -0.0005);
        }
        tick_on(over ? 2.6 : 2.4, 0.0, 1, 0.0005); /* 1 N of slew and 1 N of texture */
        assert_int_equal(only(JUDGE_SLEW), over);
        tick_on(over ? 3.7 : 3.3, 0.0, 1, 0.0005); /* the height is the same */
        assert_int_equal(only(JUDGE_SLEW), 2 * over);
    }
}

TEST(a_vibrations_own_steps_are_allowed_and_no_more) {
    for (int over = 0; over < 2; over++) {
        begin();
        judge_vibrate(&j, KNURL_WAVE_T1, 250.0, 1.0, 0.5); /* 2 ticks up, 2 down */
        tick_of(over ? 2.1 : 1.9, 0.0);
        tick_of(over ? 2.1 : 1.9, 0.0);
        tick_of(-0.1, 0.0);
        assert_int_equal(only(JUDGE_SLEW), over);
    }
}

TEST(a_squeezed_force_that_is_let_go_at_once_is_found) {
    begin();
    grow(4.0);
    tick.flags = KNURL_TICK_SQUEEZED;
    tick_of(3.1, 0.0);
    KEPT();
    tick_of(1.0, 0.0);
    assert_int_equal(only(JUDGE_SQUEEZED), 1);
}

TEST(motors_that_get_too_warm_are_found) {
    begin();
    grow(2.0);
    for (int k = 0; k < 5000; k++) {
        tick_of(2.0, 0.0);
    }
    KEPT();
    grow(4.0);
    for (int k = 0; k < 300; k++) {
        tick_of(4.0, 0.0);
    }
    assert_true(only(JUDGE_HEAT) > 0);
}

TEST(a_force_after_a_halt_or_without_a_position_is_found_and_so_is_one_that_does_not_come_back_by_the_ramp) {
    for (int absent = 0; absent < 2; absent++) {
        begin();
        grow(1.0);
        j.halted = !absent;
        j.absent = absent;
        write_force(0.1, 0.0);
        assert_int_equal(only(absent ? JUDGE_ABSENT : JUDGE_HALTED), 1);
        begin();
        grow(1.0);
        j.halted = !absent;
        j.absent = absent;
        write_force(0.0, 0.0);
        for (int k = 1; k <= 20; k++) {
            tick_of(5.0 * k / 20.0 - 0.01, 0.0);
        }
        KEPT();
        j.halted = 1;
        write_force(0.0, 0.0);
        tick_of(0.9, 0.0);
        assert_int_equal(only(JUDGE_RAMP), 1);
    }
}

TEST(a_force_after_the_ramp_of_a_pause_or_of_a_gain_of_0_is_found) {
    for (int muted = 0; muted < 2; muted++) {
        begin();
        grow(4.0);
        j.paused = !muted;
        j.gain = muted ? 0.0 : 1.0;
        for (int k = 1; k <= 20; k++) {
            tick_of(4.0 * (1.0 - k / 20.0), 0.0);
        }
        tick_of(0.0, 0.0);
        KEPT();
        tick_of(0.01, 0.0);
        assert_int_equal(only(muted ? JUDGE_MUTED : JUDGE_PAUSED), 1);
    }
}

TEST(a_tick_that_tells_another_force_than_is_sent_is_found) {
    begin();
    tick.device_force[0] = 0.5;
    write_force(0.6, 0.0);
    judge_tick(&j, &tick, NULL, 0);
    assert_int_equal(only(JUDGE_TOLD), 1);
}

TEST(a_force_that_is_left_at_an_end_is_found) {
    begin();
    grow(2.0);
    judge_expect_zero(&j, JUDGE_CLOSED);
    assert_int_equal(only(JUDGE_CLOSED), 1);
    begin();
    grow(2.0);
    write_force(0.0, 0.0);
    judge_expect_zero(&j, JUDGE_CLOSED);
    j.closed = 1;
    KEPT();
    write_force(0.1, 0.0);
    assert_int_equal(only(JUDGE_CLOSED), 1);
}

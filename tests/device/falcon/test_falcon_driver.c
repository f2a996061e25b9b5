/* The Falcon's driver over a simulated device: opening, positions, forces, gains, homing and buttons.
 * SPDX-License-Identifier: MIT */
#include "falcon_rig.h"

#include <stdlib.h>

TEST_WITH(positions_are_where_the_grip_is, begin, end) {
    static const double places[][3] = {{0.0, 0.0, 0.0}, {0.03, -0.02, 0.01}, {-0.04, 0.04, 0.04}, {0.0, 0.0, -0.04}};
    for (size_t i = 0; i < COUNT_OF(places); i++) {
        restart();
        falcon_sim_put(&fake.sim, places[i][0], places[i][1], places[i][2]);
        open_ready();
        const outcome o = run(20, no_force);
        assert_true(o.good > 0);
        for (int axis = 0; axis < 3; axis++) { /* half a count a leg; at the corners a count is up to 0.1 mm */
            CHECK_CLOSE(o.newest.position[axis], places[i][axis], 0.0002);
        }
    }
}

TEST_WITH(a_force_comes_out_at_the_grip_as_it_went_in, begin, end) {
    static const double forces[][3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}, {-0.7, 1.1, -2.0}};
    uint64_t seed = 3;
    for (size_t i = 0; i < COUNT_OF(forces); i++) {
        double at[3];
        random_vector(&seed, -0.03, 0.03, at);
        restart();
        falcon_sim_put(&fake.sim, at[0], at[1], at[2]);
        open_ready();
        (void)run(40, forces[i]);
        const falcon_sim sim = falcon_fake_look(&fake);
        for (int axis = 0; axis < 3; axis++) { /* half a unit a motor, half a count a leg: below 1 % */
            CHECK_CLOSE(sim.force[axis], forces[i][axis], 0.02);
        }
        assert_int_equal(sim.flags, 4 + 1); /* blue, homing */
    }
}

/* Recorded packets of the maker's own driver have 0.35 to 0.53 of libnifalcon's units for a force. */
TEST_WITH(no_force_is_stronger_than_was_asked_for_with_any_gain_that_the_device_may_have, begin, end) {
    const double force[3] = {0.0, 1.2, 1.6}; /* 2 N */
    const double gains[] = {0.35, 0.44, 0.53};
    for (size_t i = 0; i < COUNT_OF(gains); i++) {
        restart();
        falcon_sim_put(&fake.sim, 0.01, 0.0, 0.0);
        fake.sim.gain = gains[i];
        open_ready();
        (void)run(40, force);
        const falcon_sim sim = falcon_fake_look(&fake);
        const double length =
            sqrt(sim.force[0] * sim.force[0] + sim.force[1] * sim.force[1] + sim.force[2] * sim.force[2]);
        CHECK_CLOSE(length, 2.0 * 0.35 / gains[i], 0.03);
    }
}

TEST_WITH(a_gain_that_was_weighed_can_be_set_and_is_reported, begin, end) {
    const double force[3] = {0.0, 0.0, 1.5};
    falcon_sim_put(&fake.sim, 0.0, 0.0, 0.0);
    fake.sim.gain = 0.5;
    open_ready_with("?gain=0.5");
    (void)run(40, force);
    CHECK_CLOSE(falcon_fake_look(&fake).force[2], 1.5, 0.02);
    const knurl_device_info info = device_info(device);
    assert_string_equal(info.name, "Novint Falcon, gain 0.5");
}

static void check_open_refused(const char *options, knurl_result code, const char *words) {
    const knurl_falcon_bus bus = falcon_fake_bus(&fake);
    CHECK_REFUSED(knurl_falcon_open_on(&bus, options, &device), code, device);
    check_message(words);
}

TEST_WITH(a_gain_out_of_its_range_is_refused_before_anything_is_opened, begin, end) {
    static const char *const bad[] = {"0", "-0.5", "0.049", "1.001", "nan", "inf", "0,5", "half", "0.5x", "1e400"};
    for (size_t i = 0; i < COUNT_OF(bad); i++) {
        char options[64];
        char found[64];
        (void)snprintf(options, sizeof options, "?gain=%s", bad[i]);
        (void)snprintf(found, sizeof found, "gain: expected a number from 0.05 to 1, found '%s'", bad[i]);
        check_open_refused(options, KNURL_ERROR_ARGUMENT, found);
    }
    assert_int_equal(fake.opens, 0);
}

TEST_WITH(homing_lasts_through_forces_because_every_frame_asks_for_it, begin, end) {
    const double force[3] = {0.0, 0.0, 1.0};
    fake.sim.homed = 0;
    fake.sim.homes_at = 20;
    open_ready();
    (void)events_of(KNURL_FAULT_UNCALIBRATED);
    const outcome o = run(200, force);
    assert_int_equal(o.not_ready + o.lost, 0);
    assert_int_equal(events_of(KNURL_FAULT_UNCALIBRATED), 0);
}

TEST_WITH(motor_commands_stay_within_their_limits, begin, end) {
    const double force[3] = {8.9, 0.0, 0.0};
    falcon_sim_put(&fake.sim, 0.0, 0.0, 0.0);
    fake.sim.gain = 1.0;
    open_ready_with("?gain=1");
    (void)run(40, force);
    const falcon_sim sim = falcon_fake_look(&fake);
    assert_int_equal(sim.overdriven, 0);
    CHECK_CLOSE(sim.force[0], 7.05, 0.01); /* 4096 units by virtual work, worked out apart from this */
    CHECK_CLOSE(sim.force[1], 0.0, 0.02);
    CHECK_CLOSE(sim.force[2], 0.0, 0.02);
}

TEST_WITH(closing_leaves_the_motors_without_force, begin, end) {
    const double force[3] = {1.0, 2.0, 1.0};
    open_ready();
    (void)run(30, force);
    assert_false(is_limp());
    knurl_device_close(device);
    device = NULL;
    assert_true(is_limp());
}

TEST_WITH(an_unhomed_device_is_red_and_limp_until_it_is_homed, begin, end) {
    const double force[3] = {1.0, 0.0, 0.0};
    fake.sim.homed = 3;
    fake.sim.homes_at = 120;
    open_with("");
    outcome o = run(60, force);
    assert_int_equal(o.good, 0);
    assert_true(is_limp());
    assert_int_equal(falcon_fake_look(&fake).flags, 8 + 1);
    assert_int_equal(events_of(KNURL_FAULT_UNCALIBRATED), 1);
    assert_int_equal(others, 0);
    (void)run(80, no_force);
    o = run(20, no_force);
    assert_int_equal(o.not_ready, 0);
    assert_int_equal(falcon_fake_look(&fake).flags, 2 + 1); /* green */
    knurl_port_release_halt(device);
    (void)run(20, force);
    assert_int_equal(falcon_fake_look(&fake).flags, 4 + 1);
}

/* 8 ms are shorter than the link's patience, so that reads go on all the time; the motors had no force in them. */
TEST_WITH(a_homing_that_is_lost_for_a_moment_does_not_end_in_the_full_force_at_once, begin, end) {
    const double force[3] = {1.0, 0.0, 0.0};
    falcon_sim_put(&fake.sim, 0.0, 0.0, 0.0);
    open_ready();
    (void)run(30, force);
    CHECK_CLOSE(falcon_fake_look(&fake).force[0], 1.0, 0.02);
    falcon_fake_inject(&fake, DOUBLE_UNHOMED);
    assert_int_equal(run(8, force).not_ready, 0);
    assert_true(is_limp());
    falcon_fake_inject(&fake, DOUBLE_WELL);
    (void)run(5, force);
    assert_true(is_limp());
    assert_true(knurl_port_is_halted(device)); /* for which a loop ramps */
    knurl_port_release_halt(device);
    (void)run(5, force);
    CHECK_CLOSE(falcon_fake_look(&fake).force[0], 1.0, 0.02);
}

/* The largest present motor value. */
static int strongest_motor(void) {
    const falcon_sim sim = falcon_fake_look(&fake);
    int most = 0;
    for (int leg = 0; leg < 3; leg++) {
        most = abs(sim.motors[leg]) > most ? abs(sim.motors[leg]) : most;
    }
    return most;
}

TEST_WITH(a_loop_comes_back_from_lost_homings_of_any_length_by_the_ramp, begin, end) {
    static const int gaps_ms[] = {1, 3, 8, 11, 100};
    static double force[3] = {0.0, 2.0, 0.0}; /* the teardown ends the loop */
    falcon_sim_put(&fake.sim, 0.0, 0.0, 0.0);
    open_with("");
    const knurl_loop_desc desc = push_desc(device, force);
    running = start_push(&desc);
    sleep_ms(100);
    const int full = strongest_motor();
    assert_true(full > 100);
    for (size_t i = 0; i < COUNT_OF(gaps_ms); i++) {
        int before = 0;
        int steepest = 0;
        falcon_fake_inject(&fake, DOUBLE_UNHOMED);
        sleep_ms(gaps_ms[i]);
        falcon_fake_inject(&fake, DOUBLE_WELL);
        sleep_ms(2);
        assert_true(strongest_motor() < full / 4);
        for (int ms = 0; ms < 60; ms++) {
            const int now = strongest_motor();
            steepest = now - before > steepest && ms > 0 ? now - before : steepest;
            before = now;
            sleep_ms(1);
        }
        assert_int_equal(before, full);
        assert_true(steepest <= full / 7); /* a ramp of 20 ms; up to three of its steps between two samples */
    }
}

TEST_WITH(buttons_are_reported, begin, end) {
    open_ready();
    for (uint32_t buttons = 0; buttons < 16; buttons++) {
        knurl_system_mutex_lock(&fake.lock);
        fake.sim.buttons = buttons;
        knurl_system_mutex_unlock(&fake.lock);
        const outcome o = run(15, no_force);
        assert_int_equal(o.newest.buttons, buttons);
    }
}

TEST_WITH(opening_that_fails_leaves_nothing_open, begin, end) {
    fake.denied = 1;
    check_open_refused("", KNURL_ERROR_SYSTEM, "");
    fake.denied = 0;
    fake.fault = DOUBLE_UNPLUG;
    check_open_refused("", KNURL_ERROR_DEVICE_LOST, "");
    fake.fault = DOUBLE_MUTE;
    check_open_refused("", KNURL_ERROR_DEVICE_LOST, "");
}

TEST_WITH(invalid_options_are_refused_before_anything_is_opened, begin, end) {
    check_open_refused("second", KNURL_ERROR_ARGUMENT, "");
    check_open_refused("?colour=red", KNURL_ERROR_ARGUMENT, "firmware");
    assert_int_equal(fake.opens, 0);
}

TEST_WITH(an_image_may_be_named_by_the_environment, begin, end) {
    falcon_sim_forget_firmware(&fake.sim, 2000, 0);
    assert_int_equal(setenv("KNURL_FALCON_FIRMWARE", "/nowhere/from_environment.bin", 1), 0);
    check_open_refused("", KNURL_ERROR_IO, "/nowhere/from_environment.bin");
    check_open_refused("?firmware=/nowhere/else.bin", KNURL_ERROR_IO, "/nowhere/else.bin");
    assert_int_equal(unsetenv("KNURL_FALCON_FIRMWARE"), 0);
}

TEST_WITH(a_device_says_what_it_is, begin, end) {
    open_ready();
    const knurl_device_info info = device_info(device);
    assert_string_equal(info.name, "Novint Falcon, gain 0.35 (not weighed)");
    CHECK_CLOSE(info.max_force, 8.9, 1e-12);
    CHECK_CLOSE(info.native_rate, 1000.0, 1e-12);
    /* a count of all legs at the centre: by the sim's own angles */
    const double low[3] = {0.0, 0.0, -0.001};
    const double high[3] = {0.0, 0.0, 0.001};
    double angles[2][3];
    assert_true(falcon_sim_angles(low, angles[0]) && falcon_sim_angles(high, angles[1]));
    const double count = 0.0364347 * 0.017453292519943295;
    CHECK_CLOSE(info.resolution, fabs(count * 0.002 / (angles[1][0] - angles[0][0])), 0.000001);
    for (int axis = 0; axis < 3; axis++) {
        CHECK_CLOSE(info.workspace_max[axis], 0.04, 1e-12);
        CHECK_CLOSE(info.workspace_min[axis], -0.04, 1e-12);
    }
}

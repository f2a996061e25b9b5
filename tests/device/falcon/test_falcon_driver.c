/* The Falcon's driver over a simulated device: opening, positions, forces, gains, homing and buttons.
 * SPDX-License-Identifier: MIT */
#include "falcon_rig.h"

#include <stdlib.h>

TEST(positions_are_where_the_grip_is) {
    static const double places[][3] = {{0.0, 0.0, 0.0}, {0.03, -0.02, 0.01}, {-0.04, 0.04, 0.04}, {0.0, 0.0, -0.04}};
    for (size_t i = 0; i < COUNT_OF(places); i++) {
        begin();
        falcon_sim_put(&fake.sim, places[i][0], places[i][1], places[i][2]);
        knurl_device *device = open_ready();
        const outcome o = run(device, 20, no_force);
        assert_true(o.good > 0);
        for (int axis = 0; axis < 3; axis++) { /* half a count a leg; at the corners a count is up to 0.1 mm */
            CHECK_CLOSE(o.newest.position[axis], places[i][axis], 0.0002);
        }
        close_fake(device);
    }
}

TEST(a_force_comes_out_at_the_grip_as_it_went_in) {
    static const double forces[][3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}, {-0.7, 1.1, -2.0}};
    uint64_t seed = 3;
    for (size_t i = 0; i < COUNT_OF(forces); i++) {
        double at[3];
        for (int axis = 0; axis < 3; axis++) {
            at[axis] = random_between(&seed, -0.03, 0.03);
        }
        begin();
        falcon_sim_put(&fake.sim, at[0], at[1], at[2]);
        knurl_device *device = open_ready();
        (void)run(device, 40, forces[i]);
        const falcon_sim sim = falcon_fake_look(&fake);
        for (int axis = 0; axis < 3; axis++) { /* half a unit a motor, half a count a leg: below 1 % */
            CHECK_CLOSE(sim.force[axis], forces[i][axis], 0.02);
        }
        assert_int_equal(sim.flags, 4 + 1); /* blue, homing */
        close_fake(device);
    }
}

/* Recorded packets of the maker's own driver have 0.35 to 0.53 of libnifalcon's units for a force. */
TEST(no_force_is_stronger_than_was_asked_for_with_any_gain_that_the_device_may_have) {
    const double force[3] = {0.0, 1.2, 1.6}; /* 2 N */
    const double gains[] = {0.35, 0.44, 0.53};
    for (size_t i = 0; i < COUNT_OF(gains); i++) {
        begin();
        falcon_sim_put(&fake.sim, 0.01, 0.0, 0.0);
        fake.sim.gain = gains[i];
        knurl_device *device = open_ready();
        (void)run(device, 40, force);
        const falcon_sim sim = falcon_fake_look(&fake);
        const double length =
            sqrt(sim.force[0] * sim.force[0] + sim.force[1] * sim.force[1] + sim.force[2] * sim.force[2]);
        CHECK_CLOSE(length, 2.0 * 0.35 / gains[i], 0.03);
        close_fake(device);
    }
}

TEST(a_gain_that_was_weighed_can_be_set_and_is_reported) {
    const double force[3] = {0.0, 0.0, 1.5};
    begin();
    falcon_sim_put(&fake.sim, 0.0, 0.0, 0.0);
    fake.sim.gain = 0.5;
    knurl_device *device = open_ready_with("?gain=0.5");
    (void)run(device, 40, force);
    CHECK_CLOSE(falcon_fake_look(&fake).force[2], 1.5, 0.02);
    const knurl_device_info info = device_info(device);
    assert_string_equal(info.name, "Novint Falcon, gain 0.5");
    close_fake(device);
}

TEST(a_gain_out_of_its_range_is_refused_before_anything_is_opened) {
    static const char *const bad[] = {"0", "-0.5", "0.049", "1.001", "nan", "inf", "0,5", "half", "0.5x", "1e400"};
    knurl_device *device = NULL;
    begin();
    const knurl_falcon_bus bus = falcon_fake_bus(&fake);
    for (size_t i = 0; i < COUNT_OF(bad); i++) {
        char options[64];
        char found[64];
        (void)snprintf(options, sizeof options, "?gain=%s", bad[i]);
        (void)snprintf(found, sizeof found, "gain: expected a number from 0.05 to 1, found '%s'", bad[i]);
        CHECK_REFUSED(knurl_falcon_open_on(&bus, options, &device), KNURL_ERROR_ARGUMENT, device);
        check_message(found);
    }
    assert_int_equal(fake.opens, 0);
    falcon_fake_free(&fake);
}

TEST(homing_lasts_through_forces_because_every_frame_asks_for_it) {
    const double force[3] = {0.0, 0.0, 1.0};
    int others = 0;
    begin();
    fake.sim.homed = 0;
    fake.sim.homes_at = 20;
    knurl_device *device = open_ready();
    (void)events_of(device, KNURL_FAULT_UNCALIBRATED, &others);
    const outcome o = run(device, 200, force);
    assert_int_equal(o.not_ready + o.lost, 0);
    assert_int_equal(events_of(device, KNURL_FAULT_UNCALIBRATED, &others), 0);
    close_fake(device);
}

TEST(motor_commands_stay_within_their_limits) {
    const double force[3] = {8.9, 0.0, 0.0};
    begin();
    falcon_sim_put(&fake.sim, 0.0, 0.0, 0.0);
    fake.sim.gain = 1.0;
    knurl_device *device = open_ready_with("?gain=1");
    (void)run(device, 40, force);
    const falcon_sim sim = falcon_fake_look(&fake);
    assert_int_equal(sim.overdriven, 0);
    CHECK_CLOSE(sim.force[0], 7.05, 0.01); /* 4096 units by virtual work, worked out apart from this */
    CHECK_CLOSE(sim.force[1], 0.0, 0.02);
    CHECK_CLOSE(sim.force[2], 0.0, 0.02);
    close_fake(device);
}

TEST(closing_leaves_the_motors_without_force) {
    const double force[3] = {1.0, 2.0, 1.0};
    begin();
    knurl_device *device = open_ready();
    (void)run(device, 30, force);
    assert_false(is_limp());
    opened = NULL;
    knurl_device_close(device);
    assert_true(is_limp());
    falcon_fake_free(&fake);
}

TEST(an_unhomed_device_is_red_and_limp_until_it_is_homed) {
    const double force[3] = {1.0, 0.0, 0.0};
    int others = 0;
    begin();
    fake.sim.homed = 3;
    fake.sim.homes_at = 120;
    knurl_device *device = open_fake();
    outcome o = run(device, 60, force);
    assert_int_equal(o.good, 0);
    assert_true(is_limp());
    assert_int_equal(falcon_fake_look(&fake).flags, 8 + 1);
    assert_int_equal(events_of(device, KNURL_FAULT_UNCALIBRATED, &others), 1);
    assert_int_equal(others, 0);
    (void)run(device, 80, no_force);
    o = run(device, 20, no_force);
    assert_int_equal(o.not_ready, 0);
    assert_int_equal(falcon_fake_look(&fake).flags, 2 + 1); /* green */
    knurl_port_release_halt(device);
    (void)run(device, 20, force);
    assert_int_equal(falcon_fake_look(&fake).flags, 4 + 1);
    close_fake(device);
}

/* 8 ms are shorter than the link's patience, so that reads go on all the time; the motors had no force in them. */
TEST(a_homing_that_is_lost_for_a_moment_does_not_end_in_the_full_force_at_once) {
    const double force[3] = {1.0, 0.0, 0.0};
    begin();
    falcon_sim_put(&fake.sim, 0.0, 0.0, 0.0);
    knurl_device *device = open_ready();
    (void)run(device, 30, force);
    CHECK_CLOSE(falcon_fake_look(&fake).force[0], 1.0, 0.02);
    falcon_fake_inject(&fake, DOUBLE_UNHOMED);
    assert_int_equal(run(device, 8, force).not_ready, 0);
    assert_true(is_limp());
    falcon_fake_inject(&fake, DOUBLE_WELL);
    (void)run(device, 5, force);
    assert_true(is_limp());
    assert_true(knurl_port_is_halted(device)); /* for which a loop ramps */
    knurl_port_release_halt(device);
    (void)run(device, 5, force);
    CHECK_CLOSE(falcon_fake_look(&fake).force[0], 1.0, 0.02);
    close_fake(device);
}

static void push(uint64_t tick, const knurl_device_sample *sample, double force[3], void *user) {
    (void)tick;
    (void)sample;
    (void)user;
    force[1] = 2.0;
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

TEST(a_loop_comes_back_from_lost_homings_of_any_length_by_the_ramp) {
    static const int gaps_ms[] = {1, 3, 8, 11, 100};
    knurl_loop_desc desc;
    begin();
    falcon_sim_put(&fake.sim, 0.0, 0.0, 0.0);
    knurl_loop_desc_init(&desc, sizeof desc);
    desc.device = open_fake();
    desc.force_callback = push;
    assert_int_equal(knurl_loop_create(&desc, &running), KNURL_OK);
    assert_int_equal(knurl_loop_start(running), KNURL_OK);
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
    knurl_loop_destroy(running);
    running = NULL;
    close_fake(opened);
}

TEST(buttons_are_reported) {
    begin();
    knurl_device *device = open_ready();
    for (uint32_t buttons = 0; buttons < 16; buttons++) {
        knurl_system_mutex_lock(&fake.lock);
        fake.sim.buttons = buttons;
        knurl_system_mutex_unlock(&fake.lock);
        const outcome o = run(device, 15, no_force);
        assert_int_equal(o.newest.buttons, buttons);
    }
    close_fake(device);
}

TEST(opening_that_fails_leaves_nothing_open) {
    knurl_device *device = NULL;
    begin();
    const knurl_falcon_bus bus = falcon_fake_bus(&fake);
    fake.denied = 1;
    CHECK_REFUSED(knurl_falcon_open_on(&bus, "", &device), KNURL_ERROR_SYSTEM, device);
    fake.denied = 0;
    fake.fault = DOUBLE_UNPLUG;
    CHECK_REFUSED(knurl_falcon_open_on(&bus, "", &device), KNURL_ERROR_DEVICE_LOST, device);
    fake.fault = DOUBLE_MUTE;
    CHECK_REFUSED(knurl_falcon_open_on(&bus, "", &device), KNURL_ERROR_DEVICE_LOST, device);
    assert_int_equal(fake.opens, fake.closes);
    falcon_fake_free(&fake);
}

TEST(invalid_options_are_refused_before_anything_is_opened) {
    knurl_device *device = NULL;
    begin();
    const knurl_falcon_bus bus = falcon_fake_bus(&fake);
    CHECK_REFUSED(knurl_falcon_open_on(&bus, "second", &device), KNURL_ERROR_ARGUMENT, device);
    CHECK_REFUSED(knurl_falcon_open_on(&bus, "?colour=red", &device), KNURL_ERROR_ARGUMENT, device);
    check_message("firmware");
    assert_int_equal(fake.opens, 0);
    falcon_fake_free(&fake);
}

TEST(an_image_may_be_named_by_the_environment) {
    knurl_device *device = NULL;
    begin();
    falcon_sim_forget_firmware(&fake.sim, 2000, 0);
    const knurl_falcon_bus bus = falcon_fake_bus(&fake);
    assert_int_equal(setenv("KNURL_FALCON_FIRMWARE", "/nowhere/from_environment.bin", 1), 0);
    CHECK_REFUSED(knurl_falcon_open_on(&bus, "", &device), KNURL_ERROR_IO, device);
    check_message("/nowhere/from_environment.bin");
    CHECK_REFUSED(knurl_falcon_open_on(&bus, "?firmware=/nowhere/else.bin", &device), KNURL_ERROR_IO, device);
    check_message("/nowhere/else.bin");
    assert_int_equal(unsetenv("KNURL_FALCON_FIRMWARE"), 0);
    assert_int_equal(fake.opens, fake.closes);
    falcon_fake_free(&fake);
}

TEST(a_device_says_what_it_is) {
    begin();
    knurl_device *device = open_ready();
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
    close_fake(device);
}

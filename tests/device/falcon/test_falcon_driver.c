/* The Falcon's driver over a simulated device: homing, forces, buttons, and everything that can happen to a cable.
 * SPDX-License-Identifier: MIT */
#include "support/close.h"

#include "device/driver.h"
#include "device/port.h"
#include "falcon_fake.h"

#include <knurl/loop.h>
#include <stdio.h>
#include <stdlib.h>

static falcon_fake fake;
static const double no_force[3] = {0.0, 0.0, 0.0};

static knurl_device *opened; /* a test that fails leaves these so */
static knurl_loop *running;

/* A fresh device on the bus, in a moving hand. */
static void begin(void) {
    knurl_loop_destroy(running);
    running = NULL;
    knurl_device_close(opened);
    opened = NULL;
    falcon_fake_init(&fake, NULL);
}

static knurl_device *open_with(const char *options) {
    const knurl_falcon_bus bus = falcon_fake_bus(&fake);
    char all[512];
    (void)snprintf(all, sizeof all, "%s%cmotors_known=1", options, options[0] ? '&' : '?');
    if (knurl_falcon_open_on(&bus, all, &opened)) {
        fail_msg("%s", knurl_error_message());
    }
    knurl_device_register(opened);
    assert_int_equal(knurl_device_start(opened, 1000.0), KNURL_OK);
    return opened;
}

static knurl_device *open_fake(void) {
    return open_with("");
}

static void close_fake(knurl_device *device) {
    opened = NULL;
    knurl_device_close(device);
    assert_int_equal(fake.opens, fake.closes);
    falcon_fake_free(&fake);
}

static void sleep_ms(int ms) {
    knurl_system_sleep_until_ns(knurl_system_now_ns() + (int64_t)ms * 1000000);
}

typedef struct outcome {
    int good, not_ready, lost;
    knurl_device_sample newest;
    double step; /* m: longest between two readings */
} outcome;

/* A loop without a scene: reads, writes `force`, for so many ms. */
static outcome run(knurl_device *device, int ms, const double force[3]) {
    outcome o;
    memset(&o, 0, sizeof o);
    int64_t next = knurl_system_now_ns();
    for (int i = 0; i < ms; i++) {
        knurl_device_sample sample;
        const knurl_result result = knurl_device_read(device, &sample);
        if (result == KNURL_OK) {
            for (int axis = 0; axis < 3 && o.good > 0; axis++) {
                o.step = fmax(o.step, fabs(sample.position[axis] - o.newest.position[axis]));
            }
            o.newest = sample;
            o.good++;
            (void)knurl_device_write(device, force);
        } else if (result == KNURL_ERROR_DEVICE_LOST) {
            o.lost++;
        } else {
            o.not_ready++;
            (void)knurl_device_write(device, no_force);
        }
        next += 1000000;
        knurl_system_sleep_until_ns(next);
    }
    return o;
}

/* Opened, and its first position has come: until then it is halted, as a loop would have it. */
static knurl_device *open_ready_with(const char *options) {
    knurl_device *device = open_with(options);
    for (int i = 0; i < 1000 && run(device, 1, no_force).good == 0; i++) {}
    knurl_device_release_halt(device);
    return device;
}

static knurl_device *open_ready(void) {
    return open_ready_with("");
}

/* How often that fault was reported since the last call, and everything else. */
static int events_of(knurl_device *device, int32_t code, int *others) {
    int count = 0;
    knurl_device_event event;
    *others = 0;
    while (knurl_device_next_event(device, &event)) {
        count += event.code == code;
        *others += event.code != code;
    }
    return count;
}

static int is_limp(void) {
    const falcon_sim sim = falcon_fake_look(&fake);
    return !sim.motors[0] && !sim.motors[1] && !sim.motors[2];
}

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

TEST(a_gain_that_was_weighed_can_be_set_and_is_told) {
    const double force[3] = {0.0, 0.0, 1.5};
    knurl_device_info info;
    knurl_device_info_init(&info, sizeof info);
    begin();
    falcon_sim_put(&fake.sim, 0.0, 0.0, 0.0);
    fake.sim.gain = 0.5;
    knurl_device *device = open_ready_with("?gain=0.5");
    (void)run(device, 40, force);
    CHECK_CLOSE(falcon_fake_look(&fake).force[2], 1.5, 0.02);
    assert_int_equal(knurl_device_get_info(device, &info), KNURL_OK);
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

TEST(motors_are_never_told_more_than_they_may) {
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
    knurl_device_release_halt(device);
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
    assert_true(knurl_device_is_halted(device)); /* for which a loop ramps */
    knurl_device_release_halt(device);
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

/* The strongest motor, as it is told now. */
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
        assert_true(steepest <= full / 7); /* a ramp of 20 ms; up to three of its steps between two looks */
    }
    knurl_loop_destroy(running);
    running = NULL;
    close_fake(opened);
}

TEST(buttons_are_told) {
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

TEST(answers_in_pieces_change_nothing) {
    int others = 0;
    begin();
    knurl_device *device = open_ready();
    falcon_fake_inject(&fake, DOUBLE_SPLIT);
    (void)run(device, 20, no_force);
    const outcome o = run(device, 200, no_force);
    knurl_device_status status;
    knurl_device_status_init(&status, sizeof status);
    assert_int_equal(knurl_device_get_status(device, &status), KNURL_OK);
    assert_int_equal(o.not_ready + o.lost, 0);
    assert_int_equal(events_of(device, KNURL_FAULT_CORRUPT, &others), 0);
    assert_int_equal(others, 0);
    assert_int_equal(status.bad_bytes, 0);
    assert_true(status.exchanges > 100);
    close_fake(device);
}

/* A fault that must end in silence and no force, and from which it comes back by itself. */
static void check_silence(int fault, int32_t and_told) {
    const double force[3] = {1.0, 0.0, 0.0};
    int others = 0;
    int silent = 0;
    int told = 0;
    knurl_device_event event;
    begin();
    knurl_device *device = open_ready();
    (void)run(device, 30, force);
    assert_false(is_limp());
    falcon_fake_inject(&fake, fault);
    (void)run(device, 60, force);
    assert_true(is_limp());
    assert_true(knurl_device_is_halted(device));
    while (knurl_device_next_event(device, &event)) {
        silent += event.code == KNURL_FAULT_SILENT;
        told += event.code == and_told;
        others += event.code != KNURL_FAULT_SILENT && event.code != and_told;
    }
    assert_true(silent > 0);
    assert_true(and_told == 0 || told > 0);
    assert_int_equal(others, 0);
    falcon_fake_inject(&fake, DOUBLE_WELL);
    (void)run(device, 100, no_force);
    const outcome o = run(device, 20, no_force);
    assert_int_equal(o.not_ready + o.lost, 0);
    knurl_device_release_halt(device);
    (void)run(device, 20, force);
    assert_false(is_limp());
    close_fake(device);
}

TEST(a_mute_device_is_halted_and_comes_back) {
    check_silence(DOUBLE_MUTE, 0);
}

TEST(transfers_that_hang_are_silence) {
    check_silence(DOUBLE_HANG, 0);
}

TEST(answers_that_are_cut_off_are_silence) {
    check_silence(DOUBLE_SHORT, KNURL_FAULT_CORRUPT);
}

/* 20 ms late, a wall would be a motor: no position is made of such an answer. */
TEST(late_answers_are_no_positions) {
    int others = 0;
    begin();
    knurl_device *device = open_ready();
    (void)run(device, 30, no_force);
    falcon_fake_inject(&fake, DOUBLE_LATE);
    (void)run(device, 60, no_force);
    const outcome o = run(device, 200, no_force);
    assert_true(o.good < 100); /* without it all are; a host that stalls lets some through as new ones */
    assert_true(events_of(device, KNURL_FAULT_SILENT, &others) > 0);
    assert_int_equal(others, 0);
    falcon_fake_inject(&fake, DOUBLE_WELL);
    (void)run(device, 150, no_force);
    assert_int_equal(run(device, 20, no_force).not_ready, 0);
    close_fake(device);
}

/* A millimetre from where the grip was when the frames were sent whose answers come during 40 ms without the thread. */
static void check_stall(int ms_before, uint32_t unanswered, int64_t late_ns) {
    int good = 0;
    begin();
    falcon_sim_put(&fake.sim, 0.0, 0.0, 0.0);
    knurl_device *device = open_ready();
    knurl_system_mutex_lock(&fake.lock);
    fake.late_ns = 25000000;
    knurl_system_mutex_unlock(&fake.lock);
    (void)run(device, ms_before, no_force);
    knurl_system_mutex_lock(&fake.lock);
    assert_int_equal(fake.held, unanswered);
    fake.late_ns = late_ns;
    fake.stall_until = knurl_system_now_ns() + 40000000;
    falcon_sim_put(&fake.sim, 0.001, 0.0, 0.0);
    knurl_system_mutex_unlock(&fake.lock);
    (void)run(device, 39, no_force);
    for (int i = 0; i < 30; i++) {
        const outcome o = run(device, 1, no_force);
        good += o.good;
        if (o.good) {
            CHECK_CLOSE(o.newest.position[0], 0.001, 0.0002); /* half a count a leg, as above */
        }
    }
    assert_true(good > 0);
    close_fake(device);
}

TEST(answers_that_came_while_the_thread_stood_still_are_no_positions) {
    check_stall(18, 4, 0);
    check_stall(2, 1, 6000000); /* nor while the next one has not come */
}

TEST(random_bytes_are_counted_and_make_no_position) {
    int others = 0;
    begin();
    falcon_sim_put(&fake.sim, 0.01, 0.02, 0.03);
    knurl_device *device = open_ready();
    (void)run(device, 30, no_force);
    falcon_fake_inject(&fake, DOUBLE_CORRUPT);
    const outcome o = run(device, 300, no_force);
    knurl_device_status status;
    knurl_device_status_init(&status, sizeof status);
    assert_int_equal(knurl_device_get_status(device, &status), KNURL_OK);
    assert_true(status.bad_bytes >= 16 * 20);
    assert_int_equal(o.lost, 0);
    assert_true(o.step < 1e-12);
    assert_true(events_of(device, KNURL_FAULT_CORRUPT, &others) > 0);
    falcon_fake_inject(&fake, DOUBLE_WELL);
    (void)run(device, 100, no_force);
    assert_int_equal(run(device, 20, no_force).not_ready, 0);
    close_fake(device);
}

TEST(a_jump_is_a_fault_and_zeroes_the_force) {
    const double force[3] = {0.0, 0.0, 1.0};
    int others = 0;
    begin();
    falcon_sim_put(&fake.sim, 0.01, 0.0, 0.0);
    knurl_device *device = open_ready();
    (void)run(device, 30, force);
    falcon_fake_inject(&fake, DOUBLE_JUMP);
    (void)run(device, 15, force);
    assert_true(is_limp());
    assert_int_equal(events_of(device, KNURL_FAULT_JUMP, &others), 1);
    assert_int_equal(others, 0);
    close_fake(device);
}

TEST(encoders_that_no_hand_can_have_turned_are_no_position) {
    int others = 0;
    begin();
    falcon_sim_put(&fake.sim, 0.0, 0.0, 0.0);
    knurl_device *device = open_ready();
    (void)run(device, 20, no_force);
    knurl_system_mutex_lock(&fake.lock);
    fake.sim.jump[2] = 0.5; /* out of reach: the sim tells counts of 0 rad, that is -961, for all legs */
    fake.sim.jump[0] = 0.5;
    knurl_system_mutex_unlock(&fake.lock);
    (void)run(device, 40, no_force);
    assert_true(knurl_device_is_halted(device));
    assert_true(events_of(device, KNURL_FAULT_NOT_FINITE, &others) <= 1);
    close_fake(device);
}

TEST(a_pulled_cable_is_told_once_and_the_device_is_had_back) {
    const double force[3] = {1.0, 0.0, 0.0};
    int others = 0;
    begin();
    knurl_device *device = open_ready();
    (void)run(device, 20, force);
    falcon_fake_inject(&fake, DOUBLE_UNPLUG);
    outcome o = run(device, 20, force);
    assert_true(o.lost > 5);
    assert_int_equal(events_of(device, KNURL_FAULT_LOST, &others), 1);
    assert_int_equal(others, 0);
    assert_int_equal(knurl_device_reopen(device), KNURL_ERROR_DEVICE_LOST);
    falcon_fake_inject(&fake, DOUBLE_WELL);
    assert_int_equal(knurl_device_reopen(device), KNURL_OK);
    (void)run(device, 20, no_force);
    o = run(device, 20, no_force);
    assert_int_equal(o.lost + o.not_ready, 0);
    assert_int_equal(events_of(device, KNURL_FAULT_RECONNECTED, &others), 1);
    close_fake(device);
}

TEST(a_device_that_lost_its_power_as_well_needs_its_firmware_again) {
    begin();
    knurl_device *device = open_ready();
    falcon_fake_inject(&fake, DOUBLE_UNPLUG);
    (void)run(device, 20, no_force);
    falcon_fake_inject(&fake, DOUBLE_WELL);
    falcon_sim_forget_firmware(&fake.sim, 2000, 0);
    assert_int_equal(knurl_device_reopen(device), KNURL_ERROR_DEVICE_LOST);
    check_message("KNURL_FALCON_FIRMWARE");
    assert_int_equal(fake.opens, fake.closes);
    close_fake(device);
}

TEST(a_device_that_never_answers_again_is_lost_within_a_second) {
    begin();
    knurl_device *device = open_ready();
    falcon_fake_inject(&fake, DOUBLE_MUTE);
    assert_int_equal(run(device, 900, no_force).lost, 0);
    sleep_ms(200);
    assert_true(run(device, 10, no_force).lost > 0);
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

TEST(options_that_are_none_are_refused_before_anything_is_opened) {
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
    knurl_device_info info;
    knurl_device_info_init(&info, sizeof info);
    begin();
    knurl_device *device = open_ready();
    assert_int_equal(knurl_device_get_info(device, &info), KNURL_OK);
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

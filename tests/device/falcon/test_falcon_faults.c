/* The Falcon's driver when its cable or its device fails: no answers, late, broken or impossible ones, a pulled cable.
 * SPDX-License-Identifier: MIT */
#include "falcon_rig.h"

TEST(answers_in_pieces_change_nothing) {
    int others = 0;
    begin();
    knurl_device *device = open_ready();
    falcon_fake_inject(&fake, DOUBLE_SPLIT);
    (void)run(device, 20, no_force);
    const outcome o = run(device, 200, no_force);
    const knurl_device_status status = device_status(device);
    assert_int_equal(o.not_ready + o.lost, 0);
    assert_int_equal(events_of(device, KNURL_FAULT_CORRUPT, &others), 0);
    assert_int_equal(others, 0);
    assert_int_equal(status.bad_bytes, 0);
    assert_true(status.exchanges > 100);
    close_fake(device);
}

/* A fault that must end in silence and no force, and from which it comes back by itself. */
static void check_silence(int fault, int32_t and_reported) {
    const double force[3] = {1.0, 0.0, 0.0};
    int others = 0;
    int silent = 0;
    int reported = 0;
    knurl_device_event event;
    begin();
    knurl_device *device = open_ready();
    (void)run(device, 30, force);
    assert_false(is_limp());
    falcon_fake_inject(&fake, fault);
    (void)run(device, 60, force);
    assert_true(is_limp());
    assert_true(knurl_port_is_halted(device));
    while (knurl_device_next_event(device, &event)) {
        silent += event.code == KNURL_FAULT_SILENT;
        reported += event.code == and_reported;
        others += event.code != KNURL_FAULT_SILENT && event.code != and_reported;
    }
    assert_true(silent > 0);
    assert_true(and_reported == 0 || reported > 0);
    assert_int_equal(others, 0);
    falcon_fake_inject(&fake, DOUBLE_WELL);
    (void)run(device, 100, no_force);
    const outcome o = run(device, 20, no_force);
    assert_int_equal(o.not_ready + o.lost, 0);
    knurl_port_release_halt(device);
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

/* A millimetre from the grip's position at the sending of the frames whose answers arrive during 40 ms without the
 * thread. */
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
    const knurl_device_status status = device_status(device);
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
    fake.sim.jump[2] = 0.5; /* out of reach: the sim sends counts of 0 rad, that is -961, for all legs */
    fake.sim.jump[0] = 0.5;
    knurl_system_mutex_unlock(&fake.lock);
    (void)run(device, 40, no_force);
    assert_true(knurl_port_is_halted(device));
    assert_true(events_of(device, KNURL_FAULT_NOT_FINITE, &others) <= 1);
    close_fake(device);
}

TEST(a_pulled_cable_is_reported_once_and_the_device_is_found_again) {
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

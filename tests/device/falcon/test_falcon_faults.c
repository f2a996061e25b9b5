/* The Falcon's driver when its cable or its device fails: no answers, late, broken or impossible ones, a pulled cable.
 * SPDX-License-Identifier: MIT */
#include "falcon_rig.h"

TEST_WITH(answers_in_pieces_change_nothing, begin, end) {
    open_ready();
    falcon_fake_inject(&fake, DOUBLE_SPLIT);
    (void)run(20, no_force);
    const outcome o = run(200, no_force);
    const knurl_device_status status = device_status(device);
    assert_int_equal(o.not_ready + o.lost, 0);
    assert_int_equal(events_of(KNURL_FAULT_CORRUPT), 0);
    assert_int_equal(others, 0);
    assert_int_equal(status.bad_bytes, 0);
    assert_true(status.exchanges > 100);
}

/* A fault that must end in silence and no force, and from which it comes back by itself. */
static void check_silence(int fault, int32_t and_reported) {
    const double force[3] = {1.0, 0.0, 0.0};
    int silent = 0;
    int reported = 0;
    knurl_device_event event;
    open_ready();
    (void)run(30, force);
    assert_false(is_limp());
    falcon_fake_inject(&fake, fault);
    (void)run(60, force);
    assert_true(is_limp());
    assert_true(knurl_port_is_halted(device));
    others = 0;
    while (knurl_device_next_event(device, &event)) {
        silent += event.code == KNURL_FAULT_SILENT;
        reported += event.code == and_reported;
        others += event.code != KNURL_FAULT_SILENT && event.code != and_reported;
    }
    assert_true(silent > 0);
    assert_true(and_reported == 0 || reported > 0);
    assert_int_equal(others, 0);
    falcon_fake_inject(&fake, DOUBLE_WELL);
    (void)run(100, no_force);
    const outcome o = run(20, no_force);
    assert_int_equal(o.not_ready + o.lost, 0);
    knurl_port_release_halt(device);
    (void)run(20, force);
    assert_false(is_limp());
}

TEST_WITH(a_mute_device_is_halted_and_comes_back, begin, end) {
    check_silence(DOUBLE_MUTE, 0);
}

TEST_WITH(transfers_that_hang_are_silence, begin, end) {
    check_silence(DOUBLE_HANG, 0);
}

TEST_WITH(answers_that_are_cut_off_are_silence, begin, end) {
    check_silence(DOUBLE_SHORT, KNURL_FAULT_CORRUPT);
}

/* 20 ms late, a wall would be a motor: no position is made of such an answer. */
TEST_WITH(late_answers_are_no_positions, begin, end) {
    open_ready();
    (void)run(30, no_force);
    falcon_fake_inject(&fake, DOUBLE_LATE);
    (void)run(60, no_force);
    const outcome o = run(200, no_force);
    assert_true(o.good < 100); /* without it all are; a host that stalls lets some through as new ones */
    assert_true(events_of(KNURL_FAULT_SILENT) > 0);
    assert_int_equal(others, 0);
    falcon_fake_inject(&fake, DOUBLE_WELL);
    (void)run(150, no_force);
    assert_int_equal(run(20, no_force).not_ready, 0);
}

/* A millimetre from the grip's position at the sending of the frames whose answers arrive during 40 ms without the
 * thread. */
static void check_stall(int ms_before, uint32_t unanswered, int64_t late_ns) {
    int good = 0;
    falcon_sim_put(&fake.sim, 0.0, 0.0, 0.0);
    open_ready();
    knurl_system_mutex_lock(&fake.lock);
    fake.late_ns = 25000000;
    knurl_system_mutex_unlock(&fake.lock);
    (void)run(ms_before, no_force);
    knurl_system_mutex_lock(&fake.lock);
    assert_int_equal(fake.held, unanswered);
    fake.late_ns = late_ns;
    fake.stall_until = knurl_system_now_ns() + 40000000;
    falcon_sim_put(&fake.sim, 0.001, 0.0, 0.0);
    knurl_system_mutex_unlock(&fake.lock);
    (void)run(39, no_force);
    for (int i = 0; i < 30; i++) {
        const outcome o = run(1, no_force);
        good += o.good;
        if (o.good) {
            CHECK_CLOSE(o.newest.position[0], 0.001, 0.0002); /* half a count a leg, as above */
        }
    }
    assert_true(good > 0);
}

TEST_WITH(answers_that_came_while_the_thread_stood_still_are_no_positions, begin, end) {
    check_stall(18, 4, 0);
    restart();
    check_stall(2, 1, 6000000); /* nor while the next one has not come */
}

TEST_WITH(random_bytes_are_counted_and_make_no_position, begin, end) {
    falcon_sim_put(&fake.sim, 0.01, 0.02, 0.03);
    open_ready();
    (void)run(30, no_force);
    falcon_fake_inject(&fake, DOUBLE_CORRUPT);
    const outcome o = run(300, no_force);
    const knurl_device_status status = device_status(device);
    assert_true(status.bad_bytes >= 16 * 20);
    assert_int_equal(o.lost, 0);
    assert_true(o.step < 1e-12);
    assert_true(events_of(KNURL_FAULT_CORRUPT) > 0);
    falcon_fake_inject(&fake, DOUBLE_WELL);
    (void)run(100, no_force);
    assert_int_equal(run(20, no_force).not_ready, 0);
}

TEST_WITH(a_jump_is_a_fault_and_zeroes_the_force, begin, end) {
    const double force[3] = {0.0, 0.0, 1.0};
    falcon_sim_put(&fake.sim, 0.01, 0.0, 0.0);
    open_ready();
    (void)run(30, force);
    falcon_fake_inject(&fake, DOUBLE_JUMP);
    (void)run(15, force);
    assert_true(is_limp());
    assert_int_equal(events_of(KNURL_FAULT_JUMP), 1);
    assert_int_equal(others, 0);
}

TEST_WITH(encoders_that_no_hand_can_have_turned_are_no_position, begin, end) {
    falcon_sim_put(&fake.sim, 0.0, 0.0, 0.0);
    open_ready();
    (void)run(20, no_force);
    knurl_system_mutex_lock(&fake.lock);
    fake.sim.jump[2] = 0.5; /* out of reach: the sim sends counts of 0 rad, that is -961, for all legs */
    fake.sim.jump[0] = 0.5;
    knurl_system_mutex_unlock(&fake.lock);
    (void)run(40, no_force);
    assert_true(knurl_port_is_halted(device));
    assert_true(events_of(KNURL_FAULT_NOT_FINITE) <= 1);
}

TEST_WITH(a_pulled_cable_is_reported_once_and_the_device_is_found_again, begin, end) {
    const double force[3] = {1.0, 0.0, 0.0};
    open_ready();
    (void)run(20, force);
    falcon_fake_inject(&fake, DOUBLE_UNPLUG);
    outcome o = run(20, force);
    assert_true(o.lost > 5);
    assert_int_equal(events_of(KNURL_FAULT_LOST), 1);
    assert_int_equal(others, 0);
    assert_int_equal(knurl_device_reopen(device), KNURL_ERROR_DEVICE_LOST);
    falcon_fake_inject(&fake, DOUBLE_WELL);
    assert_int_equal(knurl_device_reopen(device), KNURL_OK);
    (void)run(20, no_force);
    o = run(20, no_force);
    assert_int_equal(o.lost + o.not_ready, 0);
    assert_int_equal(events_of(KNURL_FAULT_RECONNECTED), 1);
}

TEST_WITH(a_device_that_lost_its_power_as_well_needs_its_firmware_again, begin, end) {
    open_ready();
    falcon_fake_inject(&fake, DOUBLE_UNPLUG);
    (void)run(20, no_force);
    falcon_fake_inject(&fake, DOUBLE_WELL);
    falcon_sim_forget_firmware(&fake.sim, 2000, 0);
    assert_int_equal(knurl_device_reopen(device), KNURL_ERROR_DEVICE_LOST);
    check_message("KNURL_FALCON_FIRMWARE");
    assert_int_equal(fake.opens, fake.closes);
}

TEST_WITH(a_device_that_never_answers_again_is_lost_within_a_second, begin, end) {
    open_ready();
    falcon_fake_inject(&fake, DOUBLE_MUTE);
    assert_int_equal(run(900, no_force).lost, 0);
    sleep_ms(200);
    assert_true(run(10, no_force).lost > 0);
}

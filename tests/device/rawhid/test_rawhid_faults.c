/* Faults of a raw HID device: required results, and forbidden ones.
 * SPDX-License-Identifier: MIT */
#include "device/rawhid/driver_rig.h"

/* --- faults --- */

TEST_WITH(a_device_that_falls_silent_is_halted_and_comes_back, set_up, tear_down) {
    check_zeroed(DOUBLE_MUTE, KNURL_FAULT_SILENT);
    check_recovers();
}

TEST_WITH(a_device_that_hangs_zeroes_its_force_by_itself_and_comes_back, set_up, tear_down) {
    check_zeroed(DOUBLE_HANG, KNURL_FAULT_SILENT);
    check_recovers();
}

TEST_WITH(answers_that_come_late_are_no_positions, set_up, tear_down) {
    check_zeroed(DOUBLE_LATE, KNURL_FAULT_SILENT);
    check_recovers();
}

TEST_WITH(answers_that_are_cut_off_are_counted_and_told_once, set_up, tear_down) {
    check_zeroed(DOUBLE_SHORT, KNURL_FAULT_CORRUPT);
    tick_for(0.05, none);
    assert_int_equal(events_of(KNURL_FAULT_CORRUPT), 0);
    const knurl_device_status status = device_status(device);
    assert_true(status.bad_bytes >= 7 && status.bad_bytes % 7 == 0);
    check_recovers();
}

TEST_WITH(answers_of_random_bytes_are_no_positions, set_up, tear_down) {
    check_zeroed(DOUBLE_CORRUPT, KNURL_FAULT_CORRUPT);
    check_recovers();
}

TEST_WITH(a_jump_is_told_and_where_the_device_then_stays_is_believed, set_up, tear_down) {
    open_ready("");
    fake_hid_inject(&hid, DOUBLE_JUMP);
    wait_for_event(KNURL_FAULT_JUMP);
    const knurl_device_sample sample = wait_for_position();
    CHECK_CLOSE(sample.position[0], 0.05, 0.0003);
}

TEST_WITH(a_device_that_loses_its_counters_gets_no_force_until_it_is_homed, set_up, tear_down) {
    check_zeroed(DOUBLE_UNHOMED, KNURL_FAULT_UNCALIBRATED);
    knurl_device_sample sample;
    assert_false(tick_until(KNURL_OK, none, 0.1, &sample));
    knurl_system_mutex_lock(&hid.mutex);
    memset(hid.sim.offset, 0, sizeof hid.sim.offset); /* a pose that is possible, by chance */
    knurl_system_mutex_unlock(&hid.mutex);
    assert_false(tick_until(KNURL_OK, none, 0.1, &sample));
    assert_int_equal(events_of(KNURL_FAULT_UNCALIBRATED), 0); /* it is told once */
    press_button();
    (void)wait_for_position();
}

TEST_WITH(old_reports_in_the_queue_are_no_positions, set_up, tear_down) {
    uint8_t old[64] = {0};
    knurl_device_sample sample;
    hid_sim_say(&hid.sim, old);
    old[0] = 200; /* body a a tenth of a radian further: 9 mm to the right */
    open_ready("");
    for (int i = 0; i < 100; i++) {
        fake_hid_push(&hid, old, sizeof old);
        sleep_ms(1.0);
        if (knurl_device_read(device, &sample) == KNURL_OK) {
            /* a report may arrive between the driver's check of the queue and its own report */
            assert_true(fabs(sample.position[0]) < 0.0003 || fabs(sample.position[0] - 0.0086) < 0.0003);
        }
    }
    sample = wait_for_position();
    sleep_ms(10.0);
    assert_int_equal(knurl_device_read(device, &sample), KNURL_OK);
    assert_true(fabs(sample.position[0]) < 0.0003);
}

TEST_WITH(unplugged_it_is_lost_and_plugged_in_again_it_is_found, set_up, tear_down) {
    static const double force[3] = {0.0, 0.5, 0.0};
    knurl_device_sample sample;
    open_ready("");
    hold(0.05, force);
    const int64_t pulled = knurl_system_now_ns();
    fake_hid_inject(&hid, DOUBLE_UNPLUG);
    assert_true(tick_until(KNURL_ERROR_DEVICE_LOST, force, 5.0, &sample));
    assert_true(knurl_system_now_ns() - pulled < 900000000); /* reported by the system, before a second of silence */
    wait_for_event(KNURL_FAULT_LOST);
    assert_int_equal(knurl_device_reopen(device), KNURL_ERROR_DEVICE_LOST);
    check_message("16c0:0486");
    wait_until_limp(); /* by its own watchdog */
    fake_hid_inject(&hid, DOUBLE_WELL);
    assert_int_equal(knurl_device_reopen(device), KNURL_OK);
    wait_for_event(KNURL_FAULT_RECONNECTED);
    (void)wait_for_position();
    assert_int_equal(hid.opened, hid.closed + 1);
}

TEST_WITH(a_second_of_silence_is_a_device_that_is_lost, set_up, tear_down) {
    knurl_device_sample sample;
    open_ready("");
    fake_hid_inject(&hid, DOUBLE_MUTE);
    assert_true(tick_until(KNURL_ERROR_DEVICE_LOST, none, 5.0, &sample));
    fake_hid_inject(&hid, DOUBLE_WELL);
    assert_int_equal(knurl_device_reopen(device), KNURL_OK);
    (void)wait_for_position();
}

/* With home=1, and its cable in again while the hand is in mid-air: its counters are still valid. */
TEST_WITH(found_again_it_is_homed_only_if_it_lost_its_counters, set_up, tear_down) {
    knurl_device_sample sample;
    for (int loses = 0; loses < 2; loses++) {
        open_device("?home=1");
        const uint32_t commands = commands_sent();
        fake_hid_inject(&hid, DOUBLE_UNPLUG);
        assert_true(tick_until(KNURL_ERROR_DEVICE_LOST, none, 5.0, &sample));
        if (loses) {
            fake_hid_inject(&hid, DOUBLE_UNHOMED);
        }
        fake_hid_inject(&hid, DOUBLE_WELL);
        assert_int_equal(knurl_device_reopen(device), KNURL_OK);
        assert_int_equal(commands_sent() > commands, loses);
        close_device();
    }
}

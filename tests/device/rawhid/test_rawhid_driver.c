/* The raw HID driver over a simulated bus and device, on virtual time. SPDX-License-Identifier: MIT */
#include "device/rawhid/driver_rig.h"

/* --- opening --- */

TEST_WITH(it_opens_with_reports_of_14_and_of_64_bytes_and_tells_where_it_is, set_up, tear_down) {
    static const size_t lengths[2] = {14, 64};
    for (int i = 0; i < 2; i++) {
        fake_hid_destroy(&hid);
        fake_hid_init(&hid, lengths[i], NULL);
        open_device("");
        const knurl_device_sample sample = wait_for_position();
        assert_true(vec3_length(sample.position) < 0.0003); /* the middle, within the encoders' steps and friction */
        uint8_t last[HID_SIM_MOST_BYTES + 1];
        assert_int_equal(last_sent(last), lengths[i] + 1);
        close_device();
    }
}

TEST_WITH(the_first_reports_carry_no_current_and_no_command, set_up, tear_down) {
    uint8_t last[HID_SIM_MOST_BYTES + 1];
    open_device("");
    assert_true(reports_sent() > 0);
    assert_int_equal(commands_sent(), 0);
    assert_int_equal(last_sent(last), 65);
    for (size_t i = 0; i < 65; i++) {
        assert_int_equal(last[i], 0);
    }
}

TEST_WITH(it_is_named_by_vendor_and_product, set_up, tear_down) {
    static const char *const good[] = {"16c0:0486", "16C0:486", "16c0:0486?", "?", "?home=0"};
    static const char *const bad[] = {"16c0", "16c0:", ":0486", "16c0:00486", "16c0:048g", "0x16c0:0486", "first"};
    for (size_t i = 0; i < COUNT_OF(good); i++) {
        open_device(good[i]);
        close_device();
    }
    for (size_t i = 0; i < COUNT_OF(bad); i++) {
        check_open_refused(bad[i], KNURL_ERROR_ARGUMENT, bad[i]);
    }
    check_open_refused("?colour=red", KNURL_ERROR_ARGUMENT, "geometry= or home=");
    check_open_refused("?home=yes", KNURL_ERROR_ARGUMENT, "'yes'");
    check_open_refused("?geometry=/nowhere", KNURL_ERROR_IO, "/nowhere");
}

TEST_WITH(of_several_devices_the_one_that_is_named_is_opened, set_up, tear_down) {
    knurl_rawhid_found other = hid.found[0];
    knurl_rawhid_geometry geometry;
    knurl_rawhid_wanted wanted;
    knurl_rawhid_found chosen;
    size_t bytes = 0;
    other.vendor = 0x1234;
    other.product = 0x0006;
    other.sizes.in = other.sizes.out = 14;
    (void)snprintf(other.path, sizeof other.path, "/dev/hidraw1");
    hid.found[1] = other;
    hid.found_count = 2;
    knurl_rawhid_geometry_init(&geometry);
    assert_int_equal(knurl_rawhid_want("1234:6", &geometry, &wanted), KNURL_OK);
    assert_int_equal(knurl_rawhid_choose(&hid.bus, &wanted, &chosen, &bytes), KNURL_OK);
    assert_string_equal(chosen.path, "/dev/hidraw1");
    assert_int_equal(bytes, 14);
    assert_int_equal(knurl_rawhid_want("", &geometry, &wanted), KNURL_OK);
    assert_int_equal(knurl_rawhid_choose(&hid.bus, &wanted, &chosen, &bytes), KNURL_OK);
    assert_string_equal(chosen.path, "/dev/hidraw0");
    assert_int_equal(bytes, 64);
}

TEST_WITH(of_a_devices_interfaces_the_one_of_its_usage_is_opened, set_up, tear_down) {
    hid.found[1] = hid.found[0];
    hid.found[0].usage_page = 0xffc9; /* a Teensy's emulated serial port */
    hid.found[0].usage = 4;
    hid.found_count = 2;
    open_ready("");
}

TEST_WITH(why_it_cannot_be_opened_is_said_in_a_sentence, set_up, tear_down) {
    hid.found_count = 0;
    check_open_refused("", KNURL_ERROR_DEVICE_LOST, "1234:0006 (mbed) or 16c0:0486 (Teensy) and found none");
    check_open_refused("beef:1", KNURL_ERROR_DEVICE_LOST, "beef:0001 and found none");
    hid.found_count = 1;
    hid.found[0].usage_page = 0xffc9;
    check_open_refused("", KNURL_ERROR_DEVICE_LOST, "is of usage ffc9:0200; expected ffab:0200");
    hid.found[0].usage_page = 0xffab;
    hid.found[0].sizes.in = hid.found[0].sizes.out = 8;
    check_open_refused("", KNURL_ERROR_DEVICE_LOST, "reports are of 8 bytes in and 8 out; expected 14 to 64");
    hid.found[0].sizes.in = 64;
    check_open_refused("", KNURL_ERROR_DEVICE_LOST, "64 bytes in and 8 out");
    hid.found[0].sizes.out = 64;
    hid.found[0].is_denied = 1;
    check_open_refused("", KNURL_ERROR_SYSTEM, "/dev/hidraw0 is denied: copy sdk/udev/70-knurl.rules to");
    hid.found[0].is_denied = 0;
    hid.refuses_opening = 1;
    check_open_refused("", KNURL_ERROR_SYSTEM, "device or resource busy");
}

TEST_WITH(a_device_that_does_not_answer_is_not_opened, set_up, tear_down) {
    fake_hid_inject(&hid, DOUBLE_SHORT);
    check_open_refused("", KNURL_ERROR_DEVICE_LOST, "none within 0.5 s");
    check_message("175 bytes of other data"); /* 25 times 7 */
}

TEST_WITH(what_it_is_is_told, set_up, tear_down) {
    open_device("");
    const knurl_device_info info = device_info(device);
    assert_string_equal(info.name, "WoodenHaptics v2015");
    CHECK_SAME(info.max_force, 3.0); /* the force of 2 A in every direction in the middle: 3.2 N, rounded down */
    CHECK_SAME(info.max_stiffness, 1000.0);
    CHECK_SAME(info.native_rate, 1000.0);
    CHECK_SAME(info.delay, 2.0);
    CHECK_CLOSE(info.resolution, 0.000101, 1e-6);
    assert_true(info.continuous_force > 0.0 && info.continuous_force < info.max_force && info.heat_time > 0.0);
    assert_true(info.mass > 0.0);
    for (int axis = 0; axis < 3; axis++) { /* a cube whose corners are on a sphere of 100 mm */
        CHECK_CLOSE(info.workspace_max[axis], 0.1 / sqrt(3.0), 1e-9);
        CHECK_CLOSE(info.workspace_min[axis], -0.1 / sqrt(3.0), 1e-9);
    }
}

/* Opens it with a geometry file of those lines. */
static void open_with_geometry(const char *lines) {
    char path[512];
    char options[600];
    (void)snprintf(path, sizeof path, "%s/driver_%ld.geometry", KNURL_TEST_TMP, (long)getpid());
    (void)snprintf(options, sizeof options, "?motors_known=1&geometry=%s", path);
    FILE *file = fopen(path, "w");
    if (!file) {
        fail_msg("%s cannot be written", path);
        return;
    }
    (void)fputs(lines, file);
    (void)fclose(file);
    open_device(options);
    (void)remove(path);
}

TEST_WITH(a_geometry_file_makes_it_another_device, set_up, tear_down) {
    hid.found[0].vendor = 0xcafe;
    hid.found[0].product = 1;
    hid_sim_forget(&hid.sim);
    open_with_geometry("name = mine\nmax_force = 2\nvendor = 0xcafe\nproduct = 0x0001\nhome_on_open = 1\n");
    const knurl_device_info info = device_info(device);
    assert_string_equal(info.name, "mine");
    CHECK_SAME(info.max_force, 2.0);
    assert_true(commands_sent() > 0); /* home_on_open */
}

/* --- homing --- */

TEST_WITH(home_1_sets_the_counters_to_the_home_pose, set_up, tear_down) {
    uint8_t said[HID_SIM_MOST_BYTES];
    hid_sim_forget(&hid.sim);
    open_device("?home=1");
    knurl_system_mutex_lock(&hid.mutex);
    hid_sim_say(&hid.sim, said);
    knurl_system_mutex_unlock(&hid.mutex);
    assert_int_equal(commands_sent(), 1);
    for (int i = 0; i < 3; i++) { /* 0, 0, 6000, within the hand's motion */
        const int counts = (int16_t)(said[2 * i] | said[2 * i + 1] << 8);
        assert_true(abs(counts - (i == 2 ? 6000 : 0)) <= 100);
    }
}

TEST_WITH(a_device_that_does_not_take_its_counters_is_not_opened, set_up, tear_down) {
    hid.ignores_commands = 1;
    check_open_refused("?home=1", KNURL_ERROR_DEVICE_LOST, "homing: expected its encoders at 0, 0, 6000, found 0, 13");
}

TEST_WITH(a_device_that_never_was_homed_gives_no_position_and_gets_no_force, set_up, tear_down) {
    static const double force[3] = {1.0, 1.0, 1.0};
    knurl_device_sample sample;
    hid_sim_forget(&hid.sim);
    open_device("");
    wait_for_event(KNURL_FAULT_UNCALIBRATED);
    assert_false(tick_until(KNURL_OK, force, 0.1, &sample));
    assert_true(fake_hid_limp_since(&hid) != 0);
}

TEST_WITH(its_button_homes_it_and_positions_come_again_after_a_pause, set_up, tear_down) {
    open_ready("");
    assert_int_equal(events_of(KNURL_FAULT_UNCALIBRATED), 0);
    press_button();
    knurl_device_sample sample;
    assert_true(tick_until(KNURL_ERROR_DEVICE_NOT_READY, none, 5.0, &sample));
    wait_for_event(KNURL_FAULT_UNCALIBRATED);
    sample = wait_for_position();
    CHECK_CLOSE(sample.position[1], 0.205, 0.005); /* the home pose */
    CHECK_CLOSE(sample.position[2], 0.025, 0.005);
}

/* --- forces --- */

/* 2000 N/m; 0.3 N of friction, and the encoders' steps. And the motors' force is the requested one, within half a
 * milliampere per motor and the arm's motion in a millisecond. */
static int has_followed(const double force[3]) {
    const double expected[3] = {force[0] / 2000.0, force[1] / 2000.0, force[2] / 2000.0};
    knurl_device_sample sample;
    double pushed[3];
    knurl_system_mutex_lock(&hid.mutex);
    hid_sim_push(hid.sim.angles, hid.sim.current, pushed);
    knurl_system_mutex_unlock(&hid.mutex);
    return knurl_device_read(device, &sample) == KNURL_OK &&
           is_near(sample.position, expected, 0.3 / 2000.0 + 0.0002) && is_near(pushed, force, 0.02);
}

TEST_WITH(a_force_moves_the_hand_its_way_by_what_the_hand_gives, set_up, tear_down) {
    static const double forces[6][3] = {{2.0, 0.0, 0.0},  {0.0, 2.0, 0.0},  {0.0, 0.0, 2.0},
                                        {-2.0, 0.0, 0.0}, {0.0, -2.0, 0.0}, {0.0, 0.0, -2.0}};
    open_ready("");
    for (size_t i = 0; i < COUNT_OF(forces); i++) {
        int tries = 0;
        do {
            hold(0.1, forces[i]);
        } while (!has_followed(forces[i]) && ++tries < 20);
        assert_true(tries < 20);
    }
}

static int greatest_current(void) {
    int greatest = 0;
    knurl_system_mutex_lock(&hid.mutex);
    for (int i = 0; i < 3; i++) {
        greatest = abs(hid.sim.current[i]) > greatest ? abs(hid.sim.current[i]) : greatest;
    }
    knurl_system_mutex_unlock(&hid.mutex);
    return greatest;
}

TEST_WITH(no_motor_ever_gets_more_than_its_limit, set_up, tear_down) {
    static const double far[3] = {0.0, 0.0, 100.0}; /* shortened to 5 N, which is 3.1 A of a motor */
    int greatest = 0;
    open_with_geometry("max_force = 5\n");
    (void)wait_for_position();
    for (int i = 0; i < 100; i++) {
        hold(0.002, far);
        greatest = greatest_current() > greatest ? greatest_current() : greatest;
    }
    assert_int_equal(greatest, 2000);
}

TEST_WITH(closing_leaves_the_motors_without_current, set_up, tear_down) {
    static const double force[3] = {0.0, 1.0, 0.0};
    open_ready("");
    for (int i = 0; i < 100 && fake_hid_limp_since(&hid) != 0; i++) {
        hold(0.05, force);
    }
    assert_true(fake_hid_limp_since(&hid) == 0);
    close_device();
    assert_true(fake_hid_limp_since(&hid) != 0);
    assert_int_equal(greatest_current(), 0); /* earlier than by its watchdog after half a second */
    for (size_t i = 0; i < hid.last_size; i++) {
        assert_int_equal(hid.last[i], 0);
    }
}

TEST_WITH(it_hears_from_the_host_while_there_is_no_force_and_nobody_ticks, set_up, tear_down) {
    open_ready("");
    const uint32_t before = reports_sent();
    sleep_ms(150.0);
    assert_true(reports_sent() > before + 10);
}

TEST_WITH(half_a_second_without_a_report_lets_the_firmware_drop_the_motors, set_up, tear_down) {
    static const uint8_t pushing[65] = {0, 0xe8, 0x03};
    const double t = 100.0;
    hid.sim.time = t;
    assert_int_equal(hid_sim_hear(&hid.sim, t, pushing + 1, 64), 1);
    assert_true(hid_sim_limp_since(&hid.sim, t + 0.499) < 0.0);
    CHECK_CLOSE(hid_sim_limp_since(&hid.sim, t + 0.501), t + 0.5, 1e-9);
}

/* --- the list --- */

static uint32_t list(knurl_device_listing listings[8]) {
    knurl_listings found = {listings, 8, 0};
    knurl_rawhid_list(&hid.bus, &found);
    return found.count;
}

TEST_WITH(the_list_tells_what_is_there_and_why_it_cannot_be_used, set_up, tear_down) {
    knurl_device_listing listings[8];
    hid.found[1] = hid.found[0];
    hid.found[1].usage_page = 0xffc9; /* the second interface of the same device is no device */
    hid.found[2].vendor = 0x046d;     /* a mouse */
    hid.found_count = 3;
    assert_int_equal(list(listings), 1);
    assert_string_equal(listings[0].uri, "rawhid:16c0:0486");
    assert_string_equal(listings[0].name, "Simulated WoodenHaptics");
    assert_string_equal(listings[0].reason, "");
    hid.found[0].is_denied = 1;
    assert_int_equal(list(listings), 1);
    assert_non_null(strstr(listings[0].reason, "70-knurl.rules"));
    hid.found[0].usage = 1;
    assert_int_equal(list(listings), 2);
    assert_non_null(strstr(listings[0].reason, "expected ffab:0200"));
    hid.found_count = 0;
    assert_int_equal(list(listings), 1);
    assert_string_equal(listings[0].uri, "rawhid");
    assert_non_null(strstr(listings[0].reason, "1234:0006 (mbed) or 16c0:0486 (Teensy)"));
}

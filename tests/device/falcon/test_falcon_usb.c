/* The Falcon's driver over the real libusb, on emulated USB. SPDX-License-Identifier: MIT */
#include "falcon_emulated.h"
#include "support/guard.h"
#include "support/process.h"

#include "base/system.h"
#include "device/falcon/frame.h"
#include "device/falcon/transport.h"
#include "device/port.h"

#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

static const double no_force[3] = {0.0, 0.0, 0.0};

static falcon_emulation setup; /* reset by each test */
static knurl_device *device;

/* Puts a Falcon like `setup` there. */
static void plug_in(void) {
    falcon_sim_init(&setup.sim, NULL);
    assert_true(falcon_emulated_start(&setup));
}

static int end(void **state) {
    (void)state;
    knurl_device_close(device);
    device = NULL;
    falcon_emulated_stop();
    memset(&setup, 0, sizeof setup);
    return 0;
}

/* Reads and writes for so many ms; every position that came is given to `visit` for a force. Returns how many. */
static int run(int ms, double stiffness, int *lost) {
    int good = 0;
    int64_t next = knurl_system_now_ns();
    *lost = 0;
    for (int i = 0; i < ms; i++) {
        knurl_device_sample sample;
        double force[3] = {0.0, 0.0, 0.0};
        const knurl_result result = knurl_device_read(device, &sample);
        *lost += result == KNURL_ERROR_DEVICE_LOST;
        if (result == KNURL_OK) {
            good++;
            force[1] = fmax(0.0, -stiffness * sample.position[1]); /* a floor at y = 0 */
            knurl_port_release_halt(device);
        }
        (void)knurl_device_write(device, result == KNURL_OK ? force : no_force);
        next += 1000000;
        knurl_system_sleep_until_ns(next);
    }
    return good;
}

/* Until so many more positions have come, whose rate is the emulation's and the machine's; it may not get lost. */
static void run_until(uint64_t positions, double stiffness) {
    knurl_device_status status = device_status(device);
    const uint64_t enough = status.exchanges + positions;
    for (int i = 0; i < 500 && status.exchanges < enough; i++) {
        int lost = 0;
        (void)run(20, stiffness, &lost);
        assert_int_equal(lost, 0);
        status = device_status(device);
    }
    assert_true(status.exchanges >= enough);
}

static int reported(int32_t code) {
    int count = 0;
    knurl_device_event event;
    while (knurl_device_next_event(device, &event)) {
        count += event.code == code;
    }
    return count;
}

static void open_falcon(const char *uri) {
    if (knurl_device_open(uri, &device)) {
        fail_msg("%s", knurl_error_message());
    }
}

/* The hand presses 1 mm below the floor, its spring of 700 N/m against the floor's 400: it rests at their balance. */
TEST_WITH(a_loop_over_usb_holds_the_hand_off_the_floor, NULL, end) {
    plug_in();
    open_falcon("falcon");
    const int64_t begin = knurl_system_now_ns();
    run_until(500, 400.0); /* the simulated hand advances by a millisecond with each */
    const double seconds = 1e-9 * (double)(knurl_system_now_ns() - begin);
    const knurl_device_status status = device_status(device);
    const falcon_sim sim = falcon_emulated_look();
    print_message("%.0f exchanges a second, median %.2f ms, 99 %% within %.2f ms\n", (double)status.exchanges / seconds,
                  1e-6 * status.exchange_ns_p50, 1e-6 * status.exchange_ns_p99);
    assert_int_equal(sim.bad_bytes, 0);
    assert_int_equal(status.bad_bytes, 0);
    /* 700 (0.001 - d) = 400 d, give or take dry friction (0.5 N over 1100 N/m) */
    CHECK_CLOSE(sim.plant.position[1], -0.001 * 700.0 / 1100.0, 0.5 / 1100.0 + 0.0001);
    knurl_device_close(device);
    device = NULL;
    const falcon_sim after = falcon_emulated_look();
    assert_int_equal(after.motors[0] | after.motors[1] | after.motors[2], 0);
}

TEST_WITH(short_packets_change_nothing, NULL, end) {
    setup.is_split = 1;
    plug_in();
    open_falcon("falcon");
    run_until(100, 0.0);
    assert_int_equal(reported(KNURL_FAULT_CORRUPT), 0);
}

/* Ten answers in packets of 6 bytes, 27 in all, all unread until the last frame was sent. */
TEST_WITH(answers_that_wait_to_be_read_are_all_there, NULL, end) {
    static const int16_t none[3] = {0, 0, 0};
    knurl_falcon_transport transport;
    knurl_falcon_decoder decoder = {0};
    uint8_t bytes[KNURL_FALCON_PACKET];
    uint32_t answers = 0;
    setup.is_split = 1;
    plug_in();
    assert_int_equal(knurl_falcon_usb.open(NULL, &transport), KNURL_OK);
    assert_int_equal(transport.control(transport.self, 3, 2), KNURL_FALCON_DONE); /* the firmware's baud rate */
    knurl_falcon_encode(none, KNURL_FALCON_HOMING, bytes);
    for (int i = 0; i < 10; i++) {
        assert_int_equal(transport.write(transport.self, bytes, KNURL_FALCON_FRAME_BYTES, 10000), KNURL_FALCON_DONE);
    }
    for (size_t count = 0; answers < 10;) {
        assert_int_equal(transport.read(transport.self, bytes, &count, 10000), KNURL_FALCON_DONE);
        answers += knurl_falcon_decode(&decoder, bytes + KNURL_FALCON_STATUS, count - KNURL_FALCON_STATUS);
    }
    assert_int_equal(decoder.bad_bytes, 0);
    transport.close(transport.self);
}

TEST_WITH(a_mute_device_is_silent_then_lost, NULL, end) {
    int lost = 0;
    plug_in();
    open_falcon("falcon");
    run_until(1, 0.0);
    falcon_emulated_mute(1);
    (void)run(100, 0.0, &lost);
    assert_true(reported(KNURL_FAULT_SILENT) > 0);
    (void)run(1000, 0.0, &lost);
    assert_true(lost > 0);
    assert_int_equal(reported(KNURL_FAULT_LOST), 1);
}

TEST_WITH(a_pulled_cable_is_reported_at_once_and_the_device_had_back, NULL, end) {
    int lost = 0;
    plug_in();
    open_falcon("falcon");
    run_until(1, 0.0);
    falcon_emulated_unplug();
    (void)run(100, 0.0, &lost);
    assert_true(lost > 50);
    assert_int_equal(reported(KNURL_FAULT_LOST), 1);
    assert_int_equal(knurl_device_reopen(device), KNURL_ERROR_DEVICE_LOST);
    assert_true(falcon_emulated_plug_in());
    assert_int_equal(knurl_device_reopen(device), KNURL_OK);
    run_until(10, 0.0);
}

TEST_WITH(a_falcon_is_listed_and_one_that_is_not_there_says_so, NULL, end) {
    plug_in();
    assert_string_equal(listing_of("falcon").uri, "falcon");
    assert_string_equal(listing_of("falcon").reason, "");
    falcon_emulated_unplug();
    assert_non_null(strstr(listing_of("falcon").reason, "0403:cb48"));
    assert_non_null(strstr(listing_of("falcon").reason, "not connected"));
    CHECK_REFUSED(knurl_device_open("falcon", &device), KNURL_ERROR_DEVICE_LOST, device);
    check_message("0403:cb48");
}

TEST_WITH(a_device_that_somebody_else_holds_is_refused, NULL, end) {
    setup.is_held = 1;
    plug_in();
    CHECK_REFUSED(knurl_device_open("falcon", &device), KNURL_ERROR_SYSTEM, device);
    check_message("in use: by another program, by this one");
}

/* root may open everything, so it becomes user nobody for this. */
TEST_WITH(a_device_that_may_not_be_used_names_the_rule, NULL, end) {
    plug_in();
    char root[512];
    (void)snprintf(root, sizeof root, "%s", falcon_emulated_node());
    root[strlen(root) - strlen("/dev/bus/usb/001/002")] = '\0';
    process open_up = process_start((const char *const[]){"/bin/chmod", "-R", "a+rwX", root, NULL}, NULL);
    process_finish(&open_up);
    process_free(&open_up);
    assert_int_equal(chmod(falcon_emulated_node(), 0), 0);
    const int is_root = geteuid() == 0;
    if (is_root) {
        assert_int_equal(seteuid(65534), 0);
    }
    const knurl_device_listing listing = listing_of("falcon");
    const knurl_result result = knurl_device_open("falcon", &device);
    if (is_root) {
        assert_int_equal(seteuid(0), 0);
    }
    assert_int_equal(result, KNURL_ERROR_SYSTEM);
    check_message("sdk/udev/70-knurl.rules|udevadm trigger");
    assert_non_null(strstr(listing.reason, "sdk/udev/70-knurl.rules"));
}

/* libusb does not expose descriptors: checks that the one found is the device's. */
TEST_WITH(a_guard_gets_the_devices_own_descriptor, NULL, end) {
    knurl_falcon_transport transport;
    struct stat node;
    struct stat shared;
    int32_t endpoint = 0;
    plug_in();
    assert_int_equal(knurl_falcon_usb.open(NULL, &transport), KNURL_OK);
    const int fd = transport.share(transport.self, &endpoint);
    assert_true(fd > 2);
    assert_int_equal(fstat(fd, &shared), 0);
    assert_int_equal(stat(falcon_emulated_node(), &node), 0);
    assert_true(shared.st_ino == node.st_ino && shared.st_dev == node.st_dev);
    assert_int_equal(endpoint, 2);
    (void)close(fd);
    transport.close(transport.self);
}

/* Its transfers are for the kernel, which is not here; see test_guard_process.c. */
TEST_WITH(with_a_guard_it_works_and_is_free_again_and_one_that_is_killed_is_reported, NULL, end) {
    struct stat node;
    plug_in();
    assert_int_equal(stat(falcon_emulated_node(), &node), 0);
    for (int i = 0; i < 3; i++) {
        open_falcon("falcon:?guard=1");
        run_until(50, 400.0);
        assert_int_equal(reported(KNURL_FAULT_UNGUARDED), 0);
        if (i == 2) {
            assert_int_equal(kill(find_guard(node.st_ino), SIGKILL), 0);
            run_until(100, 400.0);
            assert_int_equal(reported(KNURL_FAULT_UNGUARDED), 1);
        }
        knurl_device_close(device);
        device = NULL;
    }
}

/* The raw HID driver as it is, on hidapi as it is, over an emulated hidraw device. Nothing here is about time: there is
 * more between both than on a machine with a device. SPDX-License-Identifier: MIT */
#include "support/close.h"
#include "support/terminal.h"

#include "base/vec3.h"
#include "device/driver.h"
#include "device/port.h"
#include "device/rawhid/emulated_hid.h"
#include "device/rawhid/ticking.h"

#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#define NOBODY 65534

static emulated_hid hid;

static const double none[3] = {0.0, 0.0, 0.0};

static knurl_device *device;       /* closed by tear_down() */
static knurl_device_sample latest; /* reading */

static int set_up(void **state) {
    (void)state;
    emulated_hid_init(&hid);
    return 0;
}

static void close_device(void) {
    knurl_device_close(device);
    device = NULL;
}

static int tear_down(void **state) {
    (void)state;
    close_device();
    emulated_hid_destroy(&hid);
    return 0;
}

static void plug(uint16_t usage_page, uint8_t report_bytes) {
    need_terminal();
    assert_int_equal(emulated_hid_plug(&hid, usage_page, report_bytes, NULL), 1);
}

static void open_device(void) {
    if (knurl_device_open("rawhid", &device)) {
        fail_msg("%s", knurl_error_message());
    }
}

/* Ticks until a read returns `result`, which it must within 5 s. */
static void tick_until(knurl_result result, const double force[3]) {
    assert_true(tick_device_until(device, result, force, 5.0, &latest));
}

/* Plugs it in and opens it; its first position has come. */
static void open_ready(uint8_t report_bytes) {
    plug(0xffab, report_bytes);
    open_device();
    tick_until(KNURL_OK, none);
}

static void mute(int is_mute) {
    knurl_system_mutex_lock(&hid.mutex);
    hid.is_mute = is_mute;
    knurl_system_mutex_unlock(&hid.mutex);
}

/* Ticks like a loop that always recovers from halts, which load may cause. */
static void hold(const double force[3], double seconds) {
    const int64_t until = knurl_system_now_ns() + (int64_t)(seconds * 1e9);
    while (knurl_system_now_ns() < until) {
        (void)knurl_device_read(device, &latest);
        knurl_port_release_halt(device);
        (void)knurl_device_write(device, force);
        sleep_ms(1.0);
    }
}

/* 2000 N/m; 0.3 N of friction, and the encoders' steps. */
static int has_followed(const double force[3]) {
    int near = knurl_device_read(device, &latest) == KNURL_OK;
    for (int axis = 0; axis < 3; axis++) {
        near = near && fabs(latest.position[axis] - force[axis] / 2000.0) <= 0.3 / 2000.0 + 0.0002;
    }
    return near;
}

static double limp_since(void) {
    knurl_system_mutex_lock(&hid.mutex);
    const double since = hid_sim_limp_since(&hid.sim, 1e-9 * (double)knurl_system_now_ns());
    knurl_system_mutex_unlock(&hid.mutex);
    return since;
}

static void check_refused(knurl_result code, const char *words) {
    knurl_device *second = NULL;
    CHECK_REFUSED(knurl_device_open("rawhid", &second), code, second);
    check_message(words);
}

static knurl_device_listing listed(void) {
    knurl_device_listing listings[8];
    knurl_listings found = {listings, 8, 0};
    knurl_rawhid_driver.list(&found);
    assert_int_equal(found.count, 1);
    return listings[0];
}

TEST_WITH(no_device_is_a_sentence, set_up, tear_down) {
    check_refused(KNURL_ERROR_DEVICE_LOST, "found none");
    assert_non_null(strstr(listed().reason, "not connected"));
}

TEST_WITH(it_is_listed_opened_and_closed_again_and_again, set_up, tear_down) {
    plug(0xffab, 64);
    const knurl_device_listing listing = listed();
    assert_string_equal(listing.uri, "rawhid:16c0:0486");
    assert_string_equal(listing.name, "Teensyduino WoodenHaptics");
    assert_string_equal(listing.reason, "");
    for (int i = 0; i < 5; i++) {
        open_device();
        tick_until(KNURL_OK, none);
        assert_true(vec3_length(latest.position) < 0.0003);
        close_device();
    }
}

TEST_WITH(a_force_moves_the_hand_its_way_and_closing_ends_it, set_up, tear_down) {
    static const double force[3] = {1.0, -2.0, 0.5};
    open_ready(64);
    int tries = 0;
    do {
        hold(force, 1.0);
    } while (!has_followed(force) && ++tries < 15);
    assert_true(tries < 15);
    close_device();
    sleep_ms(20.0);
    assert_true(limp_since() >= 0.0);
}

TEST_WITH(reports_of_14_bytes_work_as_well, set_up, tear_down) {
    open_ready(14);
}

TEST_WITH(an_interface_of_another_usage_is_refused_in_a_sentence, set_up, tear_down) {
    plug(0xffc9, 64);
    check_refused(KNURL_ERROR_DEVICE_LOST, "/dev/hidraw0) is there, but is of usage ffc9:0200; expected ffab:0200");
    assert_non_null(strstr(listed().reason, "another firmware"));
}

TEST_WITH(a_descriptor_of_reports_that_are_too_short_is_refused_in_a_sentence, set_up, tear_down) {
    plug(0xffab, 8);
    check_refused(KNURL_ERROR_DEVICE_LOST, "reports are of 8 bytes in and 8 out; expected 14 to 64");
}

/* A child has one thread. Locks of the emulation's threads stay locked in it: the C library resets its own locks,
 * AddressSanitizer's run time does not, and the child would hang in malloc(). */
static void skip_under_sanitizers(void) {
    if (SUITE_SANITIZED) {
        print_message("skipped: under a sanitizer a child of a program with threads cannot allocate\n");
        skip();
    }
}

/* In a process of user nobody, because root may open everything. */
TEST_WITH(permission_denied_names_the_rule_that_helps, set_up, tear_down) {
    skip_under_sanitizers();
    plug(0xffab, 64);
    gchar *root = umockdev_testbed_get_root_dir(hid.testbed);
    const int is_root = geteuid() == 0;
    char node[1024];
    (void)snprintf(node, sizeof node, "%s/dev/hidraw0", root);
    const int is_closed = (!is_root || chmod(root, 0755) == 0) && chmod(node, 0) == 0;
    g_free(root);
    if (!is_closed) {
        print_message("skipped: the emulated node's mode cannot be changed\n");
        skip();
    }
    const pid_t child = fork();
    if (child == 0) {
        if (is_root && (setgid(NOBODY) != 0 || setuid(NOBODY) != 0)) {
            _exit(1);
        }
        const knurl_result result = knurl_device_open("rawhid", &device);
        if (result != KNURL_ERROR_SYSTEM || !strstr(knurl_error_message(), "copy sdk/udev/70-knurl.rules")) {
            print_error("%d: %s\n", (int)result, knurl_error_message());
            _exit(2);
        }
        _exit(strstr(listed().reason, "permission to open /dev/hidraw0 is denied") ? 0 : 3);
    }
    int status = 0;
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status));
    assert_int_equal(WEXITSTATUS(status), 0);
}

TEST_WITH(muted_it_is_halted_and_comes_back, set_up, tear_down) {
    static const double force[3] = {0.0, 0.5, 0.0};
    open_ready(64);
    (void)tick_device_until(device, 1, force, 0.1, &latest);
    mute(1);
    tick_until(KNURL_ERROR_DEVICE_NOT_READY, force);
    sleep_ms(50.0);
    assert_true(limp_since() >= 0.0);
    mute(0);
    tick_until(KNURL_OK, none);
}

TEST_WITH(unplugged_it_is_lost_and_plugged_in_again_it_is_found, set_up, tear_down) {
    open_ready(64);
    const int64_t pulled = knurl_system_now_ns();
    emulated_hid_unplug(&hid);
    tick_until(KNURL_ERROR_DEVICE_LOST, none);
    assert_true(knurl_system_now_ns() - pulled < 500000000); /* reported by the system, not by a second's silence */
    assert_int_equal(knurl_device_reopen(device), KNURL_ERROR_DEVICE_LOST);
    plug(0xffab, 64);
    assert_int_equal(knurl_device_reopen(device), KNURL_OK);
    tick_until(KNURL_OK, none);
}

/* In a child, until it is killed. */
static void push_for_ever(void) {
    static const double force[3] = {0.0, 0.5, 0.0};
    if (knurl_device_open("rawhid:?guard=1", &device)) {
        print_error("%s\n", knurl_error_message());
        _exit(2);
    }
    hold(force, 20.0);
    _exit(3);
}

/* The guard writes to the node through a second descriptor, because hidapi does not expose its own. */
TEST_WITH(a_guard_zeroes_the_currents_of_a_host_that_is_killed_or_stands_still, set_up, tear_down) {
    skip_under_sanitizers();
    for (int number = SIGKILL, k = 0; k < 2; number = SIGSTOP, k++) {
        int status = 0;
        if (k == 0) {
            plug(0xffab, 64);
        }
        const pid_t child = fork();
        if (child == 0) {
            push_for_ever();
        }
        for (int i = 0; i < 5000 && limp_since() >= 0.0; i++) {
            sleep_ms(1.0);
        }
        assert_true(limp_since() < 0.0);
        sleep_ms(50.0);
        const double killed = 1e-9 * (double)knurl_system_now_ns();
        assert_int_equal(kill(child, number), 0);
        for (int i = 0; i < 400 && limp_since() < killed; i++) {
            sleep_ms(1.0);
        }
        print_message("signal %d: zero after %.1f ms\n", number, 1e3 * (limp_since() - killed));
        assert_true(limp_since() >= killed && limp_since() - killed < 0.1); /* its firmware alone: 0.5 s */
        assert_int_equal(kill(child, SIGKILL), 0);
        assert_int_equal(waitpid(child, &status, 0), child);
        assert_true(WIFSIGNALED(status));
    }
}

/* --- one at a time --- */

TEST_WITH(a_second_opening_in_this_program_is_refused_in_a_sentence, set_up, tear_down) {
    open_ready(64);
    check_refused(KNURL_ERROR_SYSTEM, "/dev/hidraw0 could not be opened: it is in use");
    tick_until(KNURL_OK, none); /* the first one continues */
    close_device();
    open_device();
}

/* A second program. Returns its exit code: 0 if it was refused with a message. */
static int open_in_another_program(void) {
    int status = 0;
    const pid_t child = fork();
    if (child == 0) {
        const knurl_result result = knurl_device_open("rawhid", &device);
        _exit(result == KNURL_OK                                                         ? 1
              : result != KNURL_ERROR_SYSTEM || !strstr(knurl_error_message(), "in use") ? 2
                                                                                         : 0);
    }
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status));
    return WEXITSTATUS(status);
}

TEST_WITH(a_device_that_another_program_has_is_refused_in_a_sentence, set_up, tear_down) {
    skip_under_sanitizers();
    open_ready(64);
    assert_int_equal(open_in_another_program(), 0);
    tick_until(KNURL_OK, none);
}

/* Only the kernel cleans up then. */
TEST_WITH(a_program_that_was_killed_has_no_device_any_more, set_up, tear_down) {
    skip_under_sanitizers();
    int pipes[2];
    int status = 0;
    char opened = 0;
    plug(0xffab, 64);
    assert_int_equal(pipe(pipes), 0);
    const pid_t child = fork();
    if (child == 0) {
        const char told = knurl_device_open("rawhid", &device) == KNURL_OK ? 'y' : 'n';
        (void)!write(pipes[1], &told, 1);
        (void)pause();
        _exit(0);
    }
    assert_int_equal(read(pipes[0], &opened, 1), 1);
    assert_int_equal(opened, 'y');
    check_refused(KNURL_ERROR_SYSTEM, "in use");
    assert_int_equal(kill(child, SIGKILL), 0);
    assert_int_equal(waitpid(child, &status, 0), child);
    open_device();
    (void)close(pipes[0]);
    (void)close(pipes[1]);
}

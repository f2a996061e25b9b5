/* Force Dimension's library lists the devices that it can open: a device without permission is not listed, and must not
 * be reported as missing. On emulated USB. SPDX-License-Identifier: MIT */
#include "device/dhd/dhd_double.h"
#include "support/close.h"

#include <stdio.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <umockdev.h>
#include <unistd.h>

#define NOBODY 65534

/* An omega, as an lsusb of one shows it. */
static UMockdevTestbed *plug_in(void) {
    GError *error = NULL;
    UMockdevTestbed *testbed = umockdev_testbed_new();
    static const char omega[] = "P: /devices/pci0000:00/usb1/1-2\n"
                                "N: bus/usb/001/002\n"
                                "E: DEVTYPE=usb_device\n"
                                "E: DEVNAME=/dev/bus/usb/001/002\n"
                                "E: PRODUCT=1451/402/100\n"
                                "E: SUBSYSTEM=usb\n"
                                "A: idVendor=1451\n"
                                "A: idProduct=0402\n";
    if (!umockdev_testbed_add_from_string(testbed, omega, &error)) {
        fail_msg("%s", error->message);
    }
    return testbed;
}

/* In a process of user nobody, because root may open everything. */
TEST(a_device_that_may_not_be_opened_is_not_called_missing) {
    int status = 0;
    char node[1024];
    knurl_device *device = NULL;
    if (SUITE_SANITIZED) { /* as in test_rawhid_usb.c */
        print_message("skipped: under a sanitizer a child of a program with threads cannot allocate\n");
        skip();
    }
    UMockdevTestbed *testbed = plug_in();
    gchar *root = umockdev_testbed_get_root_dir(testbed);
    const int is_root = geteuid() == 0;
    (void)snprintf(node, sizeof node, "%s/dev/bus/usb/001/002", root);
    assert_int_equal(chmod(root, 0755) + chmod(node, 0), 0);
    (void)snprintf(node, sizeof node, "%s/ioctl/_default", root); /* umockdev 0.19: every opened device asks it */
    (void)chmod(node, 0666);
    node[strlen(node) - strlen("/_default")] = '\0';
    (void)chmod(node, 0755);
    g_free(root);
    dhd_double.close(dhd_double.open()); /* makes the stand-in library available */
    dhd_double.inject(DOUBLE_UNPLUG);    /* and lists nothing */
    const pid_t child = fork();
    if (child == 0) {
        if (is_root && (setgid(NOBODY) != 0 || setuid(NOBODY) != 0)) {
            _exit(1);
        }
        const knurl_result result = knurl_device_open("dhd", &device);
        if (result != KNURL_ERROR_SYSTEM || !strstr(knurl_error_message(), "sdk/udev/70-knurl.rules")) {
            print_error("%d: %s\n", (int)result, knurl_error_message());
            _exit(2);
        }
        const knurl_device_listing found = listing_of("dhd");
        if (!strstr(found.reason, "1451:0402 is there, but permission to open /dev/bus/usb/001/002 is denied")) {
            print_error("%s\n", found.reason);
            _exit(3);
        }
        _exit(0);
    }
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status));
    assert_int_equal(WEXITSTATUS(status), 0);
    g_object_unref(testbed);
    assert_non_null(strstr(listing_of("dhd").reason, "not connected"));
    CHECK_REFUSED(knurl_device_open("dhd", &device), KNURL_ERROR_DEVICE_LOST, device);
}

/* As in the maker's SDK: SUBSYSTEM=="usb", ATTR{idVendor}=="1451". */
TEST(the_udev_rules_know_force_dimension) {
    char text[8192];
    FILE *file = fopen(KNURL_TEST_UDEV_RULES, "r");
    if (!file) {
        fail_msg("%s", KNURL_TEST_UDEV_RULES);
        return;
    }
    text[fread(text, 1, sizeof text - 1, file)] = '\0';
    (void)fclose(file);
    assert_non_null(strstr(text, "SUBSYSTEM==\"usb\", ATTR{idVendor}==\"1451\", TAG+=\"uaccess\""));
}

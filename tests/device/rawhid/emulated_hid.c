/* The emulated hidraw device. SPDX-License-Identifier: MIT */
#include "device/rawhid/emulated_hid.h"

#include <errno.h>
#include <linux/hidraw.h>
#include <poll.h>
#include <stdio.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

#define USB_PATH "/devices/pci0000:00/usb1/1-2"

static double seconds(void) {
    return 1e-9 * (double)knurl_system_now_ns();
}

/* Whole reports in, their ID first; an answer out for each. */
static void serve(emulated_hid *hid, const uint8_t *bytes) {
    uint8_t answer[HID_SIM_MOST_BYTES];
    knurl_system_mutex_lock(&hid->mutex);
    const int answers = hid_sim_hear(&hid->sim, seconds(), bytes + 1, hid->sim.report_bytes) && !hid->is_mute;
    hid_sim_say(&hid->sim, answer);
    knurl_system_mutex_unlock(&hid->mutex);
    if (answers && write(hid->fd, answer, hid->sim.report_bytes) < 0) {
        perror("emulated device");
    }
}

static int is_gone(emulated_hid *hid) {
    knurl_system_mutex_lock(&hid->mutex);
    const int gone = hid->is_gone;
    knurl_system_mutex_unlock(&hid->mutex);
    return gone;
}

static void *device_thread(void *argument) {
    emulated_hid *hid = argument;
    uint8_t bytes[HID_SIM_MOST_BYTES + 1];
    size_t have = 0;
    const size_t whole = hid->sim.report_bytes + 1;
    while (!is_gone(hid)) {
        struct pollfd end = {hid->fd, POLLIN, 0};
        if (poll(&end, 1, 10) <= 0) {
            continue;
        }
        const ssize_t got = read(hid->fd, bytes + have, whole - have);
        if (got <= 0) { /* the other end is not open */
            have = 0;
            usleep(1000);
            continue;
        }
        have += (size_t)got;
        if (have == whole) {
            serve(hid, bytes);
            have = 0;
        }
    }
    return NULL;
}

/* hidapi's requests when it opens a node. */
static gboolean on_ioctl(UMockdevIoctlBase *base, UMockdevIoctlClient *client, gpointer user) {
    const emulated_hid *hid = user;
    const gulong request = umockdev_ioctl_client_get_request(client);
    UMockdevIoctlData *data = NULL;
    (void)base;
    if (request == HIDIOCGRDESCSIZE) {
        data = umockdev_ioctl_data_resolve(umockdev_ioctl_client_get_arg(client), 0, sizeof(int), NULL);
        const int size = (int)sizeof hid->descriptor;
        memcpy(data->data, &size, sizeof size);
    } else if (request == HIDIOCGRDESC) {
        data = umockdev_ioctl_data_resolve(umockdev_ioctl_client_get_arg(client), 0,
                                           sizeof(struct hidraw_report_descriptor), NULL);
        struct hidraw_report_descriptor answer;
        memset(&answer, 0, sizeof answer);
        answer.size = sizeof hid->descriptor;
        memcpy(answer.value, hid->descriptor, sizeof hid->descriptor);
        memcpy(data->data, &answer, sizeof answer);
    }
    umockdev_ioctl_client_complete(client, data ? 0 : -1, data ? 0 : ENOTTY);
    if (data) {
        g_object_unref(data);
    }
    return TRUE;
}

void emulated_hid_init(emulated_hid *hid) {
    memset(hid, 0, sizeof *hid);
    hid->fd = -1;
    hid->testbed = umockdev_testbed_new();
    hid->ioctls = umockdev_ioctl_base_new();
    (void)g_signal_connect(hid->ioctls, "handle-ioctl", G_CALLBACK(on_ioctl), hid);
    knurl_system_mutex_init(&hid->mutex);
}

void emulated_hid_destroy(emulated_hid *hid) {
    emulated_hid_unplug(hid);
    g_object_unref(hid->ioctls);
    g_object_unref(hid->testbed);
    knurl_system_mutex_destroy(&hid->mutex);
}

/* As Teensy's RawHID describes itself: a vendor's usage page, usage 0200, bytes in, bytes out. */
static void describe(emulated_hid *hid, uint16_t usage_page, uint8_t report_bytes) {
    const uint8_t descriptor[28] = {0x06,
                                    (uint8_t)(usage_page & 0xff),
                                    (uint8_t)(usage_page >> 8),
                                    0x0a,
                                    0x00,
                                    0x02,
                                    0xa1,
                                    0x01,
                                    0x75,
                                    0x08,
                                    0x15,
                                    0x00,
                                    0x26,
                                    0xff,
                                    0x00,
                                    0x95,
                                    report_bytes,
                                    0x09,
                                    0x01,
                                    0x81,
                                    0x02,
                                    0x95,
                                    report_bytes,
                                    0x09,
                                    0x02,
                                    0x91,
                                    0x02,
                                    0xc0};
    memcpy(hid->descriptor, descriptor, sizeof descriptor);
}

/* The USB device, which stays in /sys (umockdev cannot add one twice), and its HID interface. */
static const char usb_text[] = "P: " USB_PATH "\nE: SUBSYSTEM=usb\nE: DEVTYPE=usb_device\nE: PRODUCT=16c0/486/112\n"
                               "A: idVendor=16c0\\n\nA: idProduct=0486\\n\nA: manufacturer=Teensyduino\\n\n"
                               "A: product=WoodenHaptics\\n\nA: serial=42\\n\nA: bcdDevice=0112\\n\n"
                               "A: busnum=1\\n\nA: devnum=3\\n\n\n"
                               "P: " USB_PATH "/1-2:1.0\n"
                               "E: SUBSYSTEM=usb\nE: DEVTYPE=usb_interface\nE: DRIVER=usbhid\nE: INTERFACE=3/0/0\n"
                               "A: bInterfaceNumber=00\\n\n\n";

static void name_node(const emulated_hid *hid, char node[32]) {
    (void)snprintf(node, 32, "/dev/hidraw%d", hid->plugs - 1);
}

static void name_interface(const emulated_hid *hid, char path[96]) {
    (void)snprintf(path, 96, "/sys" USB_PATH "/1-2:1.0/0003:16C0:0486.%04d", hid->plugs);
}

static int add(emulated_hid *hid) {
    char interface[96];
    char node[32];
    GString *text = g_string_new(hid->plugs++ == 0 ? usb_text : "");
    GError *error = NULL;
    name_interface(hid, interface);
    name_node(hid, node);
    g_string_append_printf(text,
                           "P: %s\nE: SUBSYSTEM=hid\nE: DRIVER=hid-generic\nE: HID_ID=0003:000016C0:00000486\n"
                           "E: HID_NAME=Teensyduino WoodenHaptics\nE: HID_UNIQ=42\nH: report_descriptor=",
                           interface + strlen("/sys"));
    for (size_t i = 0; i < sizeof hid->descriptor; i++) {
        g_string_append_printf(text, "%02X", hid->descriptor[i]);
    }
    g_string_append_printf(text,
                           "\n\nP: %s/hidraw/%s\nN: %s\nE: SUBSYSTEM=hidraw\nE: DEVNAME=%s\nE: MAJOR=242\nE: MINOR=%d\n"
                           "A: dev=242:%d\\n\nL: device=../../../%s\n",
                           interface + strlen("/sys"), node + strlen("/dev/"), node + strlen("/dev/"), node,
                           hid->plugs - 1, hid->plugs - 1, strrchr(interface, '/') + 1);
    const int added = umockdev_testbed_add_from_string(hid->testbed, text->str, &error) &&
                      umockdev_testbed_attach_ioctl(hid->testbed, node, hid->ioctls, &error);
    if (!added) {
        (void)fprintf(stderr, "emulated device: %s\n", error->message);
        g_error_free(error);
    }
    (void)g_string_free(text, TRUE);
    return added;
}

int emulated_hid_plug(emulated_hid *hid, uint16_t usage_page, uint8_t report_bytes, const knurl_stroke_desc *stroke) {
    describe(hid, usage_page, report_bytes);
    hid_sim_init(&hid->sim, report_bytes, stroke);
    hid->sim.time = hid->sim.heard_at = hid->sim.limp_from = seconds();
    hid->is_gone = hid->is_mute = 0;
    if (!add(hid)) {
        return 0;
    }
    char node[32];
    name_node(hid, node);
    hid->fd = umockdev_testbed_get_dev_fd(hid->testbed, node);
    return hid->fd >= 0 && pthread_create(&hid->thread, NULL, device_thread, hid) == 0;
}

/* umockdev remembers the terminal, and fails if the system reuses its number. */
static void forget_terminal(const emulated_hid *hid) {
    char path[1024];
    unsigned number = 0;
    gchar *root = umockdev_testbed_get_root_dir(hid->testbed);
    if (ioctl(hid->fd, TIOCGPTN, &number) == 0) {
        (void)snprintf(path, sizeof path, "%s/dev/.ptymap/_dev_pts_%u", root, number);
        (void)unlink(path);
    }
    g_free(root);
}

void emulated_hid_unplug(emulated_hid *hid) {
    char interface[96];
    char node[32];
    if (hid->fd < 0) {
        return;
    }
    name_interface(hid, interface);
    name_node(hid, node);
    knurl_system_mutex_lock(&hid->mutex);
    hid->is_gone = 1;
    knurl_system_mutex_unlock(&hid->mutex);
    (void)pthread_join(hid->thread, NULL);
    (void)umockdev_testbed_detach_ioctl(hid->testbed, node, NULL);
    umockdev_testbed_remove_device(hid->testbed, interface);
    forget_terminal(hid);
    (void)close(hid->fd);
    hid->fd = -1;
}

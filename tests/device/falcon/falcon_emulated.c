/* The part of the kernel's usbdevfs that libusb uses, over the simulated Falcon. A process's requests arrive as ioctls
 * in a thread of umockdev. SPDX-License-Identifier: MIT */
#include "falcon_emulated.h"

#include "base/system.h"

#include <errno.h>
#include <linux/usbdevice_fs.h>
#include <stdio.h>
#include <string.h>
#include <sys/ioctl.h>
#include <umockdev.h>

#define SYSTEM_PATH "/sys/devices/pci0000:00/0000:00:14.0/usb1/1-1"
#define NODE        "/dev/bus/usb/001/002"
#define QUEUE       32

/* Full speed, one configuration, one vendor-specific interface, bulk in 0x81 and out 0x02 of 64 bytes. */
static const unsigned char descriptors[] = {
    18,   1,  0x00, 2, 0, 0, 0, 8,   0x03, 0x04, 0x48, 0xcb, 0x00, 4,    1, 2,  3, 1, 9, 2, 32,   0, 1,  1, 0,
    0x80, 45, 9,    4, 0, 0, 2, 255, 255,  255,  2,    7,    5,    0x81, 2, 64, 0, 0, 7, 5, 0x02, 2, 64, 0, 0};

typedef struct request {
    UMockdevIoctlData *urb, *buffer;
    int64_t begun;
    int is_discarded;
} request;

static struct {
    knurl_mutex lock;
    falcon_emulation e;
    UMockdevTestbed *bed;
    UMockdevIoctlBase *handler;
    int is_gone;
    int is_realtime; /* umockdev's thread */
    int64_t first_frame;
    request queue[QUEUE];
    int count;
    char node[512];
} it;

static void drop(int at) {
    g_object_unref(it.queue[at].urb);
    if (it.queue[at].buffer) {
        g_object_unref(it.queue[at].buffer);
    }
    memmove(&it.queue[at], &it.queue[at + 1], (size_t)(--it.count - at) * sizeof it.queue[0]);
}

static void drop_all(void) {
    while (it.count > 0) {
        drop(it.count - 1);
    }
}

/* Fills in a request's result; 0: not done yet. */
static int is_done(request *r) {
    struct usbdevfs_urb *urb = (void *)r->urb->data;
    unsigned char *bytes = r->buffer ? r->buffer->data : NULL;
    urb->status = 0;
    if (r->is_discarded || it.is_gone || !bytes) { /* all of the driver's requests have a buffer */
        urb->status = r->is_discarded ? -ENOENT : -ESHUTDOWN;
        urb->actual_length = 0;
        return 1;
    }
    if (urb->type == USBDEVFS_URB_TYPE_CONTROL) {
        const uint32_t value = (uint32_t)bytes[2] | (uint32_t)bytes[3] << 8;
        urb->status = bytes[0] == 0x40 ? falcon_sim_control(&it.e.sim, bytes[1], value) : -EPIPE;
        urb->actual_length = 0;
        return 1;
    }
    if (urb->endpoint == 0x02) {
        falcon_sim_out(&it.e.sim, bytes, (size_t)urb->buffer_length);
        urb->actual_length = urb->buffer_length;
        return 1;
    }
    if (it.e.is_mute) {
        it.e.sim.said_count = 0;
    }
    const int64_t waited = knurl_system_now_ns() - r->begun;
    if (it.e.sim.said_count == 0 && waited < (int64_t)it.e.sim.latency_ms * 1000000) {
        return 0;
    }
    const size_t room = (size_t)urb->buffer_length;
    urb->actual_length = (int)falcon_sim_in(&it.e.sim, bytes, it.e.is_split && room > 8 ? 8 : room);
    return 1;
}

static int find_done(void) {
    for (int i = 0; i < it.count; i++) {
        if (is_done(&it.queue[i])) {
            return i;
        }
    }
    return -1;
}

static int submit(UMockdevIoctlData *argument) {
    if (it.count == QUEUE) {
        return -ENOMEM;
    }
    request r = {NULL, NULL, knurl_system_now_ns(), 0};
    r.urb = umockdev_ioctl_data_resolve(argument, 0, sizeof(struct usbdevfs_urb), NULL);
    const struct usbdevfs_urb *urb = (void *)r.urb->data;
    if (urb->buffer_length > 0) {
        r.buffer =
            umockdev_ioctl_data_resolve(r.urb, offsetof(struct usbdevfs_urb, buffer), (gsize)urb->buffer_length, NULL);
    }
    it.queue[it.count++] = r;
    return 0;
}

static int reap(UMockdevIoctlData *argument) {
    const int at = find_done();
    if (at < 0) {
        return -EAGAIN;
    }
    UMockdevIoctlData *slot = umockdev_ioctl_data_resolve(argument, 0, sizeof(void *), NULL);
    (void)umockdev_ioctl_data_set_ptr(slot, 0, it.queue[at].urb);
    g_object_unref(slot);
    drop(at);
    return 0;
}

static int discard(const UMockdevIoctlData *argument) {
    gulong address;
    memcpy(&address, argument->data, sizeof address);
    for (int i = 0; i < it.count; i++) {
        if (it.queue[i].urb->client_addr == address) {
            it.queue[i].is_discarded = 1;
            return 0;
        }
    }
    return -EINVAL;
}

static int get_capabilities(UMockdevIoctlData *argument) {
    const guint32 capabilities = USBDEVFS_CAP_ZERO_PACKET | USBDEVFS_CAP_BULK_CONTINUATION |
                                 USBDEVFS_CAP_NO_PACKET_SIZE_LIM | USBDEVFS_CAP_BULK_SCATTER_GATHER |
                                 USBDEVFS_CAP_REAP_AFTER_DISCONNECT;
    UMockdevIoctlData *to = umockdev_ioctl_data_resolve(argument, 0, sizeof capabilities, NULL);
    memcpy(to->data, &capabilities, sizeof capabilities);
    g_object_unref(to);
    return 0;
}

static int answer(gulong kind, UMockdevIoctlData *argument) {
    switch (kind) {
    case USBDEVFS_GET_CAPABILITIES:
        return get_capabilities(argument);
    case USBDEVFS_CLAIMINTERFACE:
    case USBDEVFS_DISCONNECT_CLAIM:
        return it.e.is_held ? -EBUSY : 0;
    case USBDEVFS_RELEASEINTERFACE:
    case USBDEVFS_CLEAR_HALT:
    case USBDEVFS_RESET:
        return 0;
    case USBDEVFS_GETDRIVER:
    case USBDEVFS_IOCTL:
        return -ENODATA; /* no driver of the kernel's has it */
    case USBDEVFS_SUBMITURB:
        return submit(argument);
    case USBDEVFS_REAPURB:
    case USBDEVFS_REAPURBNDELAY:
        return reap(argument);
    case USBDEVFS_DISCARDURB:
        return discard(argument);
    default:
        return -ENOTTY;
    }
}

/* With the lock held. */
static void pull(void) {
    if (!it.is_gone) {
        it.is_gone = 1;
        umockdev_testbed_uevent(it.bed, SYSTEM_PATH, "remove"); /* a kernel's node would poll as broken as well */
    }
}

static gboolean on_ioctl(UMockdevIoctlBase *base, UMockdevIoctlClient *client, gpointer user) {
    (void)base;
    (void)user;
    int code = -ENODEV;
    if (!it.is_realtime) { /* a device does not wait for other programs; without the right to it, it does */
        (void)knurl_system_make_realtime();
        it.is_realtime = 1;
    }
    knurl_system_mutex_lock(&it.lock);
    if (it.e.sim.frames > 0 && it.first_frame == 0) {
        it.first_frame = knurl_system_now_ns();
    }
    if (it.e.unplug_after > 0.0 && it.first_frame > 0 &&
        (double)(knurl_system_now_ns() - it.first_frame) > 1e9 * it.e.unplug_after) {
        pull();
    }
    const gulong kind = umockdev_ioctl_client_get_request(client);
    if (!it.is_gone || (it.count > 0 && (kind == USBDEVFS_REAPURBNDELAY || kind == USBDEVFS_DISCARDURB))) {
        code = answer(kind, umockdev_ioctl_client_get_arg(client)); /* pending requests can still be reaped */
    }
    umockdev_ioctl_client_complete(client, code < 0 ? -1 : 0, code < 0 ? -code : 0);
    knurl_system_mutex_unlock(&it.lock);
    return TRUE;
}

int falcon_emulated_plug_in(void) {
    GError *error = NULL;
    GString *text = g_string_new("P: /devices/pci0000:00/0000:00:14.0/usb1/1-1\nN: bus/usb/001/002=");
    for (size_t i = 0; i < sizeof descriptors; i++) {
        g_string_append_printf(text, "%02X", descriptors[i]);
    }
    g_string_append(text, "\nE: SUBSYSTEM=usb\nE: DEVTYPE=usb_device\nE: DEVNAME=/dev/bus/usb/001/002\nE: BUSNUM=001\n"
                          "E: DEVNUM=002\nE: MAJOR=189\nE: MINOR=1\nE: PRODUCT=403/cb48/400\nA: busnum=1\\n\n"
                          "A: devnum=2\\n\nA: speed=12\\n\nA: bConfigurationValue=1\\n\nA: idVendor=0403\\n\n"
                          "A: idProduct=cb48\\n\nA: bNumConfigurations=1\\n\nA: dev=189:1\\n\nH: descriptors=");
    for (size_t i = 0; i < sizeof descriptors; i++) {
        g_string_append_printf(text, "%02X", descriptors[i]);
    }
    g_string_append(text, "\n");
    if (it.is_gone) {
        (void)umockdev_testbed_detach_ioctl(it.bed, NODE, NULL);
    }
    const int added = umockdev_testbed_add_from_string(it.bed, text->str, &error) &&
                      umockdev_testbed_attach_ioctl(it.bed, NODE, it.handler, &error);
    (void)g_string_free(text, TRUE);
    if (!added) {
        (void)fprintf(stderr, "the emulated Falcon cannot be put there: %s\n", error ? error->message : "?");
        g_clear_error(&error);
        return 0;
    }
    knurl_system_mutex_lock(&it.lock);
    drop_all();
    it.is_gone = 0;
    knurl_system_mutex_unlock(&it.lock);
    return 1;
}

int falcon_emulated_start(const falcon_emulation *setup) {
    memset(&it, 0, sizeof it);
    it.e = *setup;
    it.bed = umockdev_testbed_new();
    if (!umockdev_in_mock_environment()) { /* the answer is cached: call it only once there is a testbed */
        (void)fprintf(stderr, "run this under umockdev-wrapper\n");
        g_object_unref(it.bed);
        return 0;
    }
    knurl_system_mutex_init(&it.lock);
    it.handler = umockdev_ioctl_base_new();
    (void)g_signal_connect(it.handler, "handle-ioctl", G_CALLBACK(on_ioctl), NULL);
    gchar *root = umockdev_testbed_get_root_dir(it.bed);
    (void)snprintf(it.node, sizeof it.node, "%s%s", root, NODE);
    g_free(root);
    return falcon_emulated_plug_in();
}

void falcon_emulated_unplug(void) {
    knurl_system_mutex_lock(&it.lock);
    pull();
    knurl_system_mutex_unlock(&it.lock);                           /* a process that has it open still gets the error */
    knurl_system_sleep_until_ns(knurl_system_now_ns() + 30000000); /* libusb still enumerates it */
    umockdev_testbed_remove_device(it.bed, SYSTEM_PATH);
}

void falcon_emulated_mute(int is_mute) {
    knurl_system_mutex_lock(&it.lock);
    it.e.is_mute = is_mute;
    knurl_system_mutex_unlock(&it.lock);
}

const char *falcon_emulated_node(void) {
    return it.node;
}

falcon_sim falcon_emulated_look(void) {
    knurl_system_mutex_lock(&it.lock);
    const falcon_sim copy = it.e.sim;
    knurl_system_mutex_unlock(&it.lock);
    return copy;
}

void falcon_emulated_stop(void) {
    (void)umockdev_testbed_detach_ioctl(it.bed, NODE, NULL);
    drop_all();
    g_object_unref(it.handler);
    g_object_unref(it.bed);
    knurl_system_mutex_destroy(&it.lock);
}

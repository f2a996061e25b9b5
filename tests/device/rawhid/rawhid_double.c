/* SPDX-License-Identifier: MIT */
#include "device/doubles.h"

#include "device/rawhid/fake_hid.h"
#include "device/rawhid/transport.h"

static fake_hid hid;

static knurl_device *open_wired(uint32_t backwards, const char *options) {
    knurl_device *device = NULL;
    fake_hid_init(&hid, 64, NULL);
    hid.sim.backwards = backwards;
    if (backwards) { /* loosely held */
        hid.sim.plant.config.hand_stiffness = 200.0;
        hid.sim.plant.config.hand_damping = 2.0;
    }
    if (knurl_rawhid_open(options, &hid.bus, &device)) {
        fake_hid_destroy(&hid);
        return NULL;
    }
    knurl_device_register(device);
    return device;
}

static knurl_device *double_open(void) {
    return open_wired(0, "?motors_known=1");
}

static knurl_device *double_open_backwards(void) {
    return open_wired(7, "");
}

/* A device that lost its counters recovers when its home button is pressed. */
static void double_inject(int fault) {
    static int latest;
    fake_hid_inject(&hid, fault);
    if (fault == DOUBLE_WELL && latest == DOUBLE_UNHOMED) {
        knurl_system_mutex_lock(&hid.mutex);
        hid.sim.info = 1;
        knurl_system_mutex_unlock(&hid.mutex);
    }
    latest = fault;
}

static int64_t double_limp_since(void) {
    return fake_hid_limp_since(&hid);
}

static void double_close(knurl_device *device) {
    knurl_device_close(device);
    fake_hid_destroy(&hid);
}

static void double_hold_grip(int is_held) {
    knurl_system_mutex_lock(&hid.mutex);
    double_hold(&hid.sim.plant, is_held);
    knurl_system_mutex_unlock(&hid.mutex);
}

/* A HID report comes whole or not at all, its encoders are whole numbers, and it has no word for a refused force. */
const device_double rawhid_double = {"rawhid",
                                     1u << DOUBLE_WELL | 1u << DOUBLE_UNPLUG | 1u << DOUBLE_MUTE | 1u << DOUBLE_HANG |
                                         1u << DOUBLE_LATE | 1u << DOUBLE_SHORT | 1u << DOUBLE_CORRUPT |
                                         1u << DOUBLE_JUMP | 1u << DOUBLE_UNHOMED,
                                     double_open,
                                     double_inject,
                                     double_limp_since,
                                     double_close,
                                     double_open_backwards,
                                     500.0,
                                     double_hold_grip};

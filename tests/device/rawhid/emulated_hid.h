/* A hidraw device under the real hidapi: umockdev's /sys and /dev, a terminal's two ends for the reports, and the
 * simulated WoodenHaptics at the far one, in real time. Only in a program that umockdev-wrapper runs.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_EMULATED_HID_H
#define KNURL_TEST_EMULATED_HID_H

#include "base/system.h"
#include "device/rawhid/hid_sim.h"

#include <pthread.h>
#include <umockdev.h>

typedef struct emulated_hid {
    UMockdevTestbed *testbed;
    UMockdevIoctlBase *ioctls;
    pthread_t thread;
    int fd;    /* the device's end; -1: not plugged in */
    int plugs; /* number of times plugged in: each time it gets another node */
    uint8_t descriptor[28];
    knurl_mutex mutex; /* over the rest */
    hid_sim sim;
    int is_mute;
    int is_gone; /* the thread is to end */
} emulated_hid;

/* An empty machine. */
void emulated_hid_init(emulated_hid *hid);
void emulated_hid_destroy(emulated_hid *hid);

/* Plugs in a Teensy (16c0:0486) whose interface is of a usage page and whose descriptor promises reports of that many
 * bytes; stroke as hid_sim_init(). 1: it is there. */
int emulated_hid_plug(emulated_hid *hid, uint16_t usage_page, uint8_t report_bytes, const knurl_stroke_desc *stroke);
void emulated_hid_unplug(emulated_hid *hid);

#endif

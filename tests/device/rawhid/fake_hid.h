/* A bus with one simulated WoodenHaptics on it, in real time, and functions to control both. SPDX-License-Identifier:
 * MIT
 */
#ifndef KNURL_TEST_FAKE_HID_H
#define KNURL_TEST_FAKE_HID_H

#include "base/system.h"
#include "device/rawhid/hid_sim.h"
#include "device/rawhid/transport.h"

#define FAKE_HID_QUEUE 64

typedef struct fake_hid {
    knurl_mutex mutex; /* for all following fields */
    hid_sim sim;
    knurl_rawhid_found found[4]; /* interfaces that are connected; the first is the device's */
    size_t found_count;
    int fault; /* DOUBLE_ */
    uint64_t random;
    uint32_t opened, closed;
    uint32_t refuses_opening;
    uint32_t ignores_commands;
    uint8_t last[HID_SIM_MOST_BYTES + 1]; /* the last report sent, its ID first */
    size_t last_size;
    uint32_t written;
    struct {
        uint8_t bytes[HID_SIM_MOST_BYTES + 8];
        size_t size;
        int64_t due;
    } queue[FAKE_HID_QUEUE];
    uint32_t head, tail;
    knurl_rawhid_bus bus;
} fake_hid;

/* Plugged in and homed; stroke as hid_sim_init(). */
void fake_hid_init(fake_hid *hid, size_t report_bytes, const knurl_stroke_desc *stroke);
void fake_hid_destroy(fake_hid *hid);

/* [any thread] */
void fake_hid_inject(fake_hid *hid, int fault);
int64_t fake_hid_limp_since(fake_hid *hid);

/* Puts a report of its own behind the others. */
void fake_hid_push(fake_hid *hid, const uint8_t *bytes, size_t size);

#endif

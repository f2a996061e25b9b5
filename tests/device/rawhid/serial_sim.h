/* The answers of the makers' Teensy 4.0 firmware woody_teensy_mini, over the simulated arm, written from its source.
 * Its encoders b and c count in the opposite direction to the older firmwares', which the arm has, and all are 0 in the
 * home pose. SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_SERIAL_SIM_H
#define KNURL_TEST_SERIAL_SIM_H

#include "device/rawhid/hid_sim.h"

#include <stdio.h>
#include <string.h>

#define SERIAL_SIM_LINE 127 /* characters of its buffer */

/* Of an arm that was homed: 6000 counts of encoder c lie between its home pose and an angle of 0. */
static inline void serial_sim_init(hid_sim *sim, const knurl_stroke_desc *stroke) {
    hid_sim_init(sim, 14, stroke);
    sim->watchdog = 0.1;
    sim->offset[2] = -6000;
}

/* Presses its button: all counters become 0 in the arm's present pose. */
static inline void serial_sim_press(hid_sim *sim) {
    hid_sim_forget(sim);
}

static inline int serial_sim_answer(const hid_sim *sim, int error, char *text, size_t size) {
    uint8_t report[HID_SIM_MOST_BYTES];
    int counts[3];
    hid_sim_say(sim, report);
    for (int i = 0; i < 3; i++) {
        const int value = report[2 * i] | report[2 * i + 1] << 8;
        counts[i] = (value < 32768 ? value : value - 65536) * (i == 0 ? 1 : -1);
    }
    return snprintf(text, size, "[3,%d,%d,%d,0,0,0,%d]\n", counts[0], counts[1], counts[2], error);
}

/* A line up to its ']': the answer's length. */
static inline int serial_sim_hear(hid_sim *sim, double time, const char *line, char *text, size_t size) {
    int ma[3];
    uint8_t report[14] = {0};
    const char *begin = strchr(line, '[');
    /* NOLINTNEXTLINE(bugprone-unchecked-string-to-number-conversion,cert-err34-c): as the firmware does */
    if (!begin || sscanf(begin, "[%d,%d,%d]", &ma[0], &ma[1], &ma[2]) != 3) {
        return serial_sim_answer(sim, 1024, text, size);
    }
    for (int i = 0; i < 3; i++) {
        const int current = (ma[i] <= 6000 && ma[i] >= -6000 ? ma[i] : 0) * (i == 0 ? 1 : -1);
        report[2 * i] = (uint8_t)((unsigned)current & 0xffu);
        report[2 * i + 1] = (uint8_t)((unsigned)current >> 8 & 0xffu);
    }
    (void)hid_sim_hear(sim, time, report, sizeof report);
    return serial_sim_answer(sim, 0, text, size);
}

#endif

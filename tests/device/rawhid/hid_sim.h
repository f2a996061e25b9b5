/* A WoodenHaptics in a hand: firmware, encoders, motors, arm. No I/O and no clock. Its kinematics are written from the
 * equations of its makers, in their axes, and inverted by root finding; it shares no code with the driver.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_HID_SIM_H
#define KNURL_TEST_HID_SIM_H

#include "device/fake/hand.h"
#include "device/fake/plant.h"

#include <stddef.h>
#include <stdint.h>

#define HID_SIM_MOST_BYTES 64

typedef struct hid_sim {
    size_t report_bytes;
    knurl_plant plant; /* Knurl's device frame */
    knurl_hand hand;
    double target[3];
    double watchdog;    /* s without a report after which its motors get nothing */
    double time;        /* s, up to which it has moved */
    double heard_at;    /* s, the last report */
    double begun_at;    /* s, the first report: then the hand comes down */
    double limp_from;   /* s: start of zero motor current; < 0: they have current */
    double shift[3];    /* m: added to the arm's position */
    double angles[3];   /* rad, of the bodies */
    int16_t offset[3];  /* counters less true counts */
    int16_t current[3]; /* mA, as commanded */
    uint32_t backwards; /* bits: motors that are wired backwards */
    int16_t info;
    uint32_t reports; /* heard */
    uint32_t commands;
} hid_sim;

/* At rest at the middle of the workspace, homed, its hand on the stroke (null: at rest). */
void hid_sim_init(hid_sim *sim, size_t report_bytes, const knurl_stroke_desc *stroke);

/* Moves on to `time` (s); a pause of more than 50 ms is skipped over. */
void hid_sim_advance(hid_sim *sim, double time);

/* A report comes in, its ID taken off: `size` bytes, ignored unless they are report_bytes. 1: it is answered. */
int hid_sim_hear(hid_sim *sim, double time, const uint8_t *report, size_t size);

/* Its report: report_bytes. */
void hid_sim_say(const hid_sim *sim, uint8_t report[HID_SIM_MOST_BYTES]);

/* It loses power, and returns without its position. */
void hid_sim_forget(hid_sim *sim);

/* s: start of zero motor current at `time`; < 0: a motor has current. */
double hid_sim_limp_since(const hid_sim *sim, double time);

/* The equations: body angles to the grip (m, makers' axes less the origin), and the inverse by Newton's method with
 * numeric slopes, from the middle of the workspace; 0 if there is no solution. */
void hid_sim_grip(const double angles[3], double own[3]);
int hid_sim_bend(const double own[3], double angles[3]);

/* The force (N, Knurl's frame) of motor currents, by virtual work with numeric slopes. */
void hid_sim_push(const double angles[3], const int16_t ma[3], double force[3]);

#endif

/* The force as a signal for actuators: samples for a voice coil, envelopes for rumble motors.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_COIL_H
#define KNURL_SRC_COIL_H

#include <knurl/hip.h>

#include <stdint.h>

#define KNURL_COIL_TAPS  8  /* ticks around a sample, from which it is computed */
#define KNURL_COIL_STEPS 64 /* of the table, a tick */

/* Ticks to samples. */
typedef struct knurl_coil {
    double history[KNURL_COIL_TAPS]; /* N, a ring */
    uint32_t next;
    double decay;          /* of the high pass, per sample */
    double before, output; /* the high pass's last input and output */
    double table[KNURL_COIL_TAPS / 2 * KNURL_COIL_STEPS + 2];
} knurl_coil;

/* A filter of second order. */
typedef struct knurl_band {
    double b[3], a[2];
    double x[2], y[2]; /* its last inputs and outputs */
} knurl_band;

/* The force along one direction, and its power in two bands. */
typedef struct knurl_rumble {
    double axis[3];
    knurl_band steady, low, high;
    double share;    /* of a tick in the mean powers */
    double power[2]; /* atomic: N^2, mean, of the low and the high band */
} knurl_rumble;

void knurl_coil_init(knurl_coil *coil, double sample_rate_hz);

/* Takes the next tick's force, N. */
void knurl_coil_push(knurl_coil *coil, double force) KNURL_NONBLOCKING;

/* The next sample, N: `at` (0 to 1) ticks after the newest tick but one, less half of the taps. Exactly 0 if the force
 * has been constant for long enough. */
double knurl_coil_pull(knurl_coil *coil, double at) KNURL_NONBLOCKING;

void knurl_rumble_init(knurl_rumble *rumble, double update_rate_hz);

/* N: a tick's force along the contact's normal or, without a contact, along the direction in which it began. Also adds
 * it to the powers. */
double knurl_rumble_update(knurl_rumble *rumble, const knurl_tick_output *tick) KNURL_NONBLOCKING;

#endif

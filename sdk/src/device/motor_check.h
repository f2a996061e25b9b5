/* Checks after opening a device that its handle moves in the direction of the force: a motor that is wired or signed
 * backwards would push with the hand instead of against it. See docs/safety.md. Pure computation.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_MOTOR_CHECK_H
#define KNURL_SRC_MOTOR_CHECK_H

#include <stdint.h>

typedef struct knurl_motor_check {
    uint32_t is_on; /* 0: finished or not used; the functions below need not be called */
    uint32_t axes;  /* bits: axes still to be checked */
    double max_force;
    double known;        /* N: smaller forces are sent unchanged */
    double limit;        /* N: of a pulse */
    double ramp;         /* N: limit along axes that have passed; rises */
    double ramp_step;    /* N a tick */
    double step;         /* s */
    uint32_t stride;     /* ticks a step */
    uint32_t tick;       /* within the step */
    uint32_t steps;      /* of the block, so far */
    uint32_t blocks;     /* since the last decision */
    uint32_t is_wanted;  /* 1: the last force needs the check */
    uint32_t polarity;   /* blocks since the device was opened */
    uint32_t is_inverse; /* 1: the block is off, on, on, off */
    double pulse[3];     /* N: the last one */
    double force[3];     /* N: sum of the block's pulses */
    double origin[3];    /* m: position when the block began */
    double response[3];  /* m: sum of the block's weighted positions */
    double start[3];     /* m: position when the first block since the last decision began */
    double sum[3];       /* m/s^2: sum of these blocks' answers */
    double latest[3];    /* m/s^2: the last answer */
    double spread;       /* (m/s^2)^2: sum of squared differences of successive answers */
} knurl_motor_check;

/* Starts with all axes unchecked. max_force: N. */
void knurl_motor_check_init(knurl_motor_check *check, double max_force);

/* Called before the first position. period: s between positions. */
void knurl_motor_check_start(knurl_motor_check *check, double period);

/* Processes a position (m). Returns 0, or 1 + the axis along which the handle does not follow the force; then the check
 * ends. */
int knurl_motor_check_step(knurl_motor_check *check, const double position[3]);

/* Limits a force (N) that is about to be sent, or turns it into part of a pulse. */
void knurl_motor_check_shape(knurl_motor_check *check, double force[3]);

#endif

/* Checks after opening a device that its handle goes where the force points: a motor that is wired or signed backwards
 * would push with the hand instead of against it. See docs/safety.md. Pure computation.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_MOTOR_CHECK_H
#define KNURL_SRC_MOTOR_CHECK_H

#include <stdint.h>

typedef struct knurl_motor_check {
    uint32_t is_on; /* 0: over, or there is none: the functions below need not be called */
    uint32_t axes;  /* bits: axes that are still to be checked */
    double max_force;
    double known;        /* N: forces up to this one are sent as they are */
    double limit;        /* N: of a pulse */
    double ramp;         /* N: limit along axes that have passed; it rises */
    double ramp_step;    /* N a tick */
    double step;         /* s */
    uint32_t stride;     /* ticks a step */
    uint32_t tick;       /* of the step */
    uint32_t steps;      /* of the block so far */
    uint32_t blocks;     /* since the latest decision */
    uint32_t is_wanted;  /* 1: the latest force needs the check */
    uint32_t polarity;   /* blocks since the device was opened */
    uint32_t is_inverse; /* 1: the block is none, force, force, none */
    double pulse[3];     /* N: the latest */
    double force[3];     /* N: sum of the block's pulses */
    double origin[3];    /* m: where the block began */
    double response[3];  /* m: sum of the block's weighted positions */
    double start[3];     /* m: where the first block since the latest decision began */
    double sum[3];       /* m/s^2: of these blocks' answers */
    double latest[3];    /* m/s^2: the latest answer */
    double spread;       /* (m/s^2)^2: sum of the squared differences between one answer and the next */
} knurl_motor_check;

/* All axes are to be checked. max_force: N. */
void knurl_motor_check_init(knurl_motor_check *check, double max_force);

/* Before the first position. period: s from one position to the next. */
void knurl_motor_check_start(knurl_motor_check *check, double period);

/* Takes in a position (m). Returns 0, or 1 + the axis along which the handle does not follow the force; the check is
 * over then. */
int knurl_motor_check_step(knurl_motor_check *check, const double position[3]);

/* Shortens a force (N) that is about to be sent, or makes it a part of a pulse. */
void knurl_motor_check_shape(knurl_motor_check *check, double force[3]);

#endif

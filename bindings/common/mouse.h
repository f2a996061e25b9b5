/* The device "mouse": the game moves the HIP, and a filter smooths the steps. There is no hardware.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_COMMON_MOUSE_H
#define KNURL_COMMON_MOUSE_H

#include <knurl/device_functions.h>

typedef struct knurl_mouse {
    /* a seqlock: atomics, written by the game thread */
    uint64_t sequence;
    double target[3]; /* m, device frame */
    /* used by the haptic thread */
    int is_there; /* 1: the game has set a position */
    double period;
    double decay; /* of the filter, a tick */
    double position[3], velocity[3];
} knurl_mouse;

/* Opens it. *mouse is owned by the device and freed with it, possibly after its close. */
knurl_result knurl_mouse_open(knurl_mouse **mouse, knurl_device **device);

/* Sets the HIP's target, device frame. [game thread] */
void knurl_mouse_move(knurl_mouse *m, const double position[3]);

#endif

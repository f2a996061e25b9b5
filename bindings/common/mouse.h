/* The device "mouse": the game moves the HIP, and a filter smooths the steps. There is no hardware.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_COMMON_MOUSE_H
#define KNURL_COMMON_MOUSE_H

#include <knurl/device_functions.h>

typedef struct knurl_mouse {
    /* from the game thread, atomics: a seqlock */
    uint64_t sequence;
    double target[3]; /* m, device frame */
    /* the haptic thread's */
    int is_there; /* 1: the game has moved it */
    double period;
    double decay; /* of the filter, a tick */
    double position[3], velocity[3];
} knurl_mouse;

/* Opens it. *mouse is the device's: it goes with that, which may be later than its close. */
knurl_result knurl_mouse_open(knurl_mouse **mouse, knurl_device **device);

/* Where the HIP is to be, device frame. [game thread] */
void knurl_mouse_move(knurl_mouse *m, const double position[3]);

#endif

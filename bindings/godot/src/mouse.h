/* The device "mouse": no device at all; the game moves the HIP, a filter makes a motion of its steps.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_GODOT_MOUSE_H
#define KNURL_GODOT_MOUSE_H

#include <knurl/device.h>

typedef struct mouse {
    /* from the game thread, atomics: a seqlock */
    uint64_t sequence;
    double target[3]; /* m, device frame */
    /* the haptic thread's */
    int is_there; /* 1: the game has moved it */
    double period;
    double decay; /* of the filter, a tick */
    double position[3], velocity[3];
} mouse;

/* Opens it; `m`, zeroed, is the caller's and must outlast the device. */
knurl_result mouse_open(mouse *m, knurl_device **device);

/* Where the HIP is to be, device frame. [game thread] */
void mouse_move(mouse *m, const double position[3]);

#endif

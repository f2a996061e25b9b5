/* A small process beside the host's that holds a device's handle and zeroes its force when the host is killed or stands
 * still. It is a program of its own: a fork that lives on would hold all of a game's memory, and have each page copied
 * that the game then writes to. The program is part of this library and is run from memory, so that nothing has to be
 * shipped beside it, found, or be executable. Linux only. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_GUARD_PROCESS_H
#define KNURL_SRC_GUARD_PROCESS_H

#include "base/finite.h"

#include <stddef.h>
#include <stdint.h>

/* What is sent to the device so that its force is 0. */
typedef struct knurl_guard_order {
    int32_t endpoint; /* of a USB device of usbfs, whose interface the host has claimed; 0: by write() */
    uint32_t size;
    uint8_t bytes[72];
} knurl_guard_order;

/* ms without a sign of life after which the force is zeroed, and so often again; how often the host gives a sign. */
#define KNURL_GUARD_SILENCE_MS 50
#define KNURL_GUARD_SIGN_MS    10

/* What the host says: a sign of life, or that the force is zero and the device about to be closed. */
#define KNURL_GUARD_ALIVE ((uint8_t)'a')
#define KNURL_GUARD_LEAVE ((uint8_t)'l')

typedef struct knurl_guard_process knurl_guard_process;

/* Starts one for an open device; `device`, a descriptor, is closed whatever comes of it. Null, and why. [not the haptic
 * thread] */
knurl_guard_process *knurl_guard_process_start(int device, const knurl_guard_order *order, char *why, size_t why_size);

/* A sign of life. 0: the guard is gone. No heap, lock or wait, but a system call. [one thread, not the haptic one] */
int knurl_guard_process_tell(knurl_guard_process *guard);

/* Has it leave without sending anything, and waits until it holds the device no more. Null is fine. */
void knurl_guard_process_stop(knurl_guard_process *guard);

#endif

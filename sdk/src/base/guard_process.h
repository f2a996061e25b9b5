/* The guard process: a small process that shares a device's handle and zeroes its force when the host is killed or
 * frozen. It is a program of its own, because a fork would keep all of the game's memory alive and make the game copy
 * each page that it writes. It is embedded in this library and run from memory, so that no file needs to be shipped or
 * found. Linux only.
 * SPDX-License-Identifier: MIT */
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

/* Messages of the host: it is alive, or the force is zero and the device is about to be closed. */
#define KNURL_GUARD_ALIVE ((uint8_t)'a')
#define KNURL_GUARD_LEAVE ((uint8_t)'l')

typedef struct knurl_guard_process knurl_guard_process;

/* Starts a guard process for an open device. `device`, a descriptor, is closed in any case. Returns null where it
 * fails, and why. [not the haptic thread] */
knurl_guard_process *knurl_guard_process_start(int device, const knurl_guard_order *order, char *why, size_t why_size);

/* Tells the guard that the host is alive. Returns 0 where the guard is gone. One system call; no heap, lock or wait.
 * [one thread, not the haptic one] */
int knurl_guard_process_tell(knurl_guard_process *guard);

/* Ends the guard without sending anything, and waits until it has closed the device. Null is allowed. */
void knurl_guard_process_stop(knurl_guard_process *guard);

#endif

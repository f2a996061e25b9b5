/* The guard process: a small process that shares a device's handle and zeroes its force if the host is killed or
 * frozen. It is a separate program, because a fork would keep all of the game's memory alive and make the game copy
 * each page that it writes. It is embedded in this library and run from memory, so that no file has to be shipped.
 * Linux only.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_GUARD_PROCESS_H
#define KNURL_SRC_GUARD_PROCESS_H

#include "base/finite.h"

#include <stddef.h>
#include <stdint.h>

/* The bytes that set the device's force to zero. */
typedef struct knurl_guard_order {
    int32_t endpoint; /* of a usbfs device whose interface the host has claimed; 0: use write() */
    uint32_t size;
    uint8_t bytes[72];
} knurl_guard_order;

/* ms without a message until the guard zeroes the force, and between repeats; ms between the host's messages. */
#define KNURL_GUARD_SILENCE_MS 50
#define KNURL_GUARD_SIGN_MS    10

/* The host's messages: it is running; the force is zero and the device is about to be closed. */
#define KNURL_GUARD_ALIVE ((uint8_t)'a')
#define KNURL_GUARD_LEAVE ((uint8_t)'l')

typedef struct knurl_guard_process knurl_guard_process;

/* Starts a guard process for an open device. device: a descriptor, always closed. Returns null and the reason in `why`
 * if it fails. [not the haptic thread] */
knurl_guard_process *knurl_guard_process_start(int device, const knurl_guard_order *order, char *why, size_t why_size);

/* Sends KNURL_GUARD_ALIVE. Returns 0 if the guard has ended. One system call; no heap, lock or wait. [one thread, not
 * the haptic one] */
int knurl_guard_process_tell(knurl_guard_process *guard);

/* Ends the guard without sending anything, and waits until it has closed the device. Null is allowed. */
void knurl_guard_process_stop(knurl_guard_process *guard);

#endif

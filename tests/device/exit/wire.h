/* Devices at the end of a socket: the driver runs in a child that will be ended, the simulated device in the test,
 * which survives and sees the device's last force. A socket replaces usbfs and hidraw, because a guard can inherit it
 * like those, unlike an emulation within a process. SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_WIRE_H
#define KNURL_TEST_WIRE_H

#include "device/touch/stub_hd.h"

#include <knurl/device_functions.h>
#include <pthread.h>

/** Shared by child and test. */
typedef struct wire_shared {
    stub_told told;   /**< to the motors; written by the test, and for the Touch by the stub in the child */
    int64_t ended_at; /**< ns: just before the child's end */
} wire_shared;

typedef struct wire_device wire_device;

/** A kind of device. */
typedef struct wire_kind {
    const char *name;
    /** The child's side: opens a device over `wire`. Null: see knurl_error_message(). */
    knurl_device *(*open)(int wire, wire_shared *shared, uint32_t guarded);
    /** The test's side: a new simulated device; one message in; 1 if the motors have a force; one message out (0: no
     * message). Null: it is in the child. */
    void (*reset)(void);
    size_t (*hear)(const uint8_t *bytes, size_t size, uint8_t *answer, int *has_force);
    const char *cannot; /**< why it cannot be guarded; null: it can */
} wire_kind;

extern const wire_kind wire_kinds[];
extern const size_t wire_kind_count;

/** A simulated device on a thread of its own. */
struct wire_device {
    const wire_kind *kind;
    wire_shared *shared;
    int wire;
    int is_closed; /**< atomic; 1: the other end is closed */
    pthread_t thread;
};

void wire_start(wire_device *device, const wire_kind *kind, int wire, wire_shared *shared);
void wire_join(wire_device *device);

#endif

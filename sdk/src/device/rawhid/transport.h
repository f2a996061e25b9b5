/* The driver's connection to USB HID; tests replace it by a simulation. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_RAWHID_TRANSPORT_H
#define KNURL_SRC_RAWHID_TRANSPORT_H

#include "device/driver.h"
#include "device/rawhid/report.h"

#define KNURL_RAWHID_FOUND 64 /* interfaces listed at most */

/* A connected HID interface. */
typedef struct knurl_rawhid_found {
    char path[256]; /* opens it */
    char name[96];  /* for display */
    uint16_t vendor, product, usage_page, usage;
    knurl_rawhid_sizes sizes; /* of its reports; 0, 0 if unknown */
    uint32_t is_denied;       /* 1: no permission to open it */
} knurl_rawhid_found;

/* An open interface. [one thread at a time] */
typedef struct knurl_rawhid_port {
    void *self;
    /* Sends a report, its ID first. Returns 1 if it was sent, otherwise 0. */
    int (*write)(void *self, const uint8_t *bytes, size_t size);
    /* Reads the next report: its length, at most `room`; 0: no report within `milliseconds`; -1: the device is gone. */
    int (*read)(void *self, uint8_t *bytes, size_t room, int milliseconds);
    void (*close)(void *self);
} knurl_rawhid_port;

typedef struct knurl_rawhid_bus {
    void *user;
    /* Lists the interfaces of that vendor and product (0: any); returns their number. [not the haptic thread] */
    size_t (*look)(void *user, uint16_t vendor, uint16_t product, knurl_rawhid_found *found, size_t capacity);
    /* Opens one of them: returns 1, or 0 and the reason. [not the haptic thread] */
    int (*open)(void *user, const knurl_rawhid_found *found, knurl_rawhid_port *port, char *why, size_t why_size);
    /* For the guard process: a descriptor that accepts reports by write(), to be closed by the caller, or -1. Null if a
     * guard is not supported. [not the haptic thread] */
    int (*share)(void *user, const knurl_rawhid_found *found);
} knurl_rawhid_bus;

/* The system's HID bus, through hidapi; null if that is missing, with the remedy in `why`. */
const knurl_rawhid_bus *knurl_rawhid_hidapi(char *why, size_t why_size);

/* The driver on any bus, for tests. options: the URI after "rawhid:". `bus` must outlive the device. Errors: as
 * knurl_device_open(). */
knurl_result knurl_rawhid_open(const char *options, const knurl_rawhid_bus *bus, knurl_device **device);

#endif

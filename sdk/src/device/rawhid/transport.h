/* The driver's connection to USB HID, which tests replace by a simulation. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_RAWHID_TRANSPORT_H
#define KNURL_SRC_RAWHID_TRANSPORT_H

#include "device/rawhid/report.h"

#define KNURL_RAWHID_FOUND 64 /* interfaces looked at */

/* One HID interface that is connected. */
typedef struct knurl_rawhid_found {
    char path[256]; /* what to open it with */
    char name[96];  /* for people */
    uint16_t vendor, product, usage_page, usage;
    knurl_rawhid_sizes sizes; /* of its reports; 0, 0 where the system does not tell */
    uint32_t is_denied;       /* 1: it may not be opened */
} knurl_rawhid_found;

/* An open interface. [one thread at a time] */
typedef struct knurl_rawhid_port {
    void *self;
    /* Sends a report, its ID first. 1: it went out; 0: it did not. */
    int (*write)(void *self, const uint8_t *bytes, size_t size);
    /* The next report: its length, at most `room`; 0: none came within `milliseconds`; -1: the device is gone. */
    int (*read)(void *self, uint8_t *bytes, size_t room, int milliseconds);
    void (*close)(void *self);
} knurl_rawhid_port;

typedef struct knurl_rawhid_bus {
    void *user;
    /* Fills in what is connected, of that vendor and product (0: any); returns how many. [not the haptic thread] */
    size_t (*look)(void *user, uint16_t vendor, uint16_t product, knurl_rawhid_found *found, size_t capacity);
    /* Opens one of them: 1, or 0 and why. [not the haptic thread] */
    int (*open)(void *user, const knurl_rawhid_found *found, knurl_rawhid_port *port, char *why, size_t why_size);
    /* For the guard process: a descriptor that takes reports by write(), to be closed by the caller, or -1. Null:
     * cannot be guarded. [not the haptic thread] */
    int (*share)(void *user, const knurl_rawhid_found *found);
} knurl_rawhid_bus;

/* The machine's own, by hidapi; null where that is missing: `why` says what helps. */
const knurl_rawhid_bus *knurl_rawhid_hidapi(char *why, size_t why_size);

#endif

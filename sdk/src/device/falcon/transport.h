/* The driver's connection to a Falcon: USB (transport_usb.c), or a simulation in tests. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_FALCON_TRANSPORT_H
#define KNURL_SRC_FALCON_TRANSPORT_H

#include "device/driver.h"

/* How a transfer ended. */
enum {
    KNURL_FALCON_DONE,
    KNURL_FALCON_NOTHING, /* not within the time, or with an error after which another try is worth while */
    KNURL_FALCON_GONE     /* the device is there no more */
};

/* What an FTDI chip sends in one USB packet: two bytes of status, then up to 62 of data, often none. */
#define KNURL_FALCON_PACKET 64
#define KNURL_FALCON_STATUS 2u

/* An open device. No two calls at once; each returns within its time. */
typedef struct knurl_falcon_transport {
    void *self; /* null: not open */
    /* A request to the FTDI chip (type 0x40, index 0, no data), 1 s at most. */
    int (*control)(void *self, uint8_t request, uint16_t value);
    /* Hands bytes over, KNURL_FALCON_PACKET at most. */
    int (*write)(void *self, const uint8_t *bytes, size_t count, uint32_t timeout_ms);
    /* The oldest packet that has not been read yet; with a time of 0, of those that have come. */
    int (*read)(void *self, uint8_t packet[KNURL_FALCON_PACKET], size_t *count, uint32_t timeout_ms);
    void (*close)(void *self);
    /* For the guard process: a descriptor to be closed by the caller, -1 where there is none, and the USB endpoint that
     * frames go to (0: by write()). Null: cannot be guarded. */
    int (*share)(void *self, int32_t *endpoint);
} knurl_falcon_transport;

/* Where Falcons are found. */
typedef struct knurl_falcon_bus {
    void (*list)(void *user, knurl_listings *listings);
    /* Opens the first one. Errors: as knurl_device_open(). */
    knurl_result (*open)(void *user, knurl_falcon_transport *transport);
    void *user;
} knurl_falcon_bus;

extern const knurl_falcon_bus knurl_falcon_usb;

/* The driver over any bus: what knurl_falcon_driver's open and list do over USB. */
knurl_result knurl_falcon_open_on(const knurl_falcon_bus *bus, const char *options, knurl_device **device);

#endif

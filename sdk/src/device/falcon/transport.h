/* The driver's connection to a Falcon: USB (transport_usb.c), or a simulation in tests. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_FALCON_TRANSPORT_H
#define KNURL_SRC_FALCON_TRANSPORT_H

#include "device/driver.h"

/* Outcome of a transfer. */
enum {
    KNURL_FALCON_DONE,
    KNURL_FALCON_NOTHING, /* timed out, or failed with an error that is worth a retry */
    KNURL_FALCON_GONE     /* the device was disconnected */
};

/* A USB packet from an FTDI chip: two bytes of status, then up to 62 of data, often empty. */
#define KNURL_FALCON_PACKET 64
#define KNURL_FALCON_STATUS 2u

/* An open device. Calls must not overlap; each returns within its time. */
typedef struct knurl_falcon_transport {
    void *self; /* null: not open */
    /* A request to the FTDI chip (type 0x40, index 0, no data), 1 s at most. */
    int (*control)(void *self, uint8_t request, uint16_t value);
    /* Sends at most KNURL_FALCON_PACKET bytes. */
    int (*write)(void *self, const uint8_t *bytes, size_t count, uint32_t timeout_ms);
    /* Reads the oldest unread packet; if timeout_ms is 0, only if it has already arrived. */
    int (*read)(void *self, uint8_t packet[KNURL_FALCON_PACKET], size_t *count, uint32_t timeout_ms);
    void (*close)(void *self);
    /* For the guard process: a descriptor to be closed by the caller, or -1, and the USB endpoint for frames (0: by
     * write()). Null if a guard is not supported. */
    int (*share)(void *self, int32_t *endpoint);
} knurl_falcon_transport;

/* Access to connected Falcons. */
typedef struct knurl_falcon_bus {
    void (*list)(void *user, knurl_listings *listings);
    /* Opens the first one. Errors: as knurl_device_open(). */
    knurl_result (*open)(void *user, knurl_falcon_transport *transport);
    void *user;
} knurl_falcon_bus;

extern const knurl_falcon_bus knurl_falcon_usb;

/* Opens the driver on any bus, as knurl_falcon_driver.open does on USB. */
knurl_result knurl_falcon_open_on(const knurl_falcon_bus *bus, const char *options, knurl_device **device);

#endif

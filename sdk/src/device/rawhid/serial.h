/* WoodenHaptics with the makers' Teensy 4.0 firmware (woody_teensy_mini, 2026): text over a USB serial port, one line
 * each way a millisecond. To the device: motor currents in mA, "[a,b,c]\n". From it: "[model,enc0,...,enc5,error]\n";
 * its button sets the encoders to 0. It switches its motors off 100 ms after the latest line. To the driver the port
 * looks like a HID device with reports of 14 bytes. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_RAWHID_SERIAL_H
#define KNURL_SRC_RAWHID_SERIAL_H

#include "device/listings.h"
#include "device/rawhid/transport.h"
#include "device/uri.h"

#define KNURL_SERIAL_VENDOR  0x16c0 /* Teensy, USB type "Serial" */
#define KNURL_SERIAL_PRODUCT 0x0483

/* An open serial port. [one thread at a time] */
typedef struct knurl_serial_wire {
    void *self;
    int (*write)(void *self, const char *text, size_t size); /* 1: all of it went out; 0: it did not */
    /* The bytes that have come, at most `room`; 0: none within `milliseconds`; -1: the port is gone. */
    int (*read)(void *self, char *text, size_t room, int milliseconds);
    void (*close)(void *self);
} knurl_serial_wire;

/* Where serial ports are found. */
typedef struct knurl_serial_ports {
    void *user;
    /* The path of the first Teensy: 1, or 0 where there is none. */
    int (*find)(void *user, char *path, size_t size);
    /* 1, or 0 and why. */
    int (*open)(void *user, const char *path, knurl_serial_wire *wire, char *why, size_t why_size);
} knurl_serial_ports;

/* The machine's own; null where this build has none. */
const knurl_serial_ports *knurl_serial_tty(void);

/* A port as the driver's bus. */
typedef struct knurl_serial_bus {
    knurl_rawhid_bus bus;
    const knurl_serial_ports *ports;
    char path[KNURL_URI_ROOM];
    int16_t home[3];   /* counts in the home pose, where the device's own are 0 */
    uint32_t is_again; /* 1: it was open before, and has lost its power with its cable */
} knurl_serial_bus;

/* `path`: "" is the first Teensy. */
void knurl_serial_bus_init(knurl_serial_bus *bus, const knurl_serial_ports *ports, const char *path,
                           const int16_t home[3]);

/* What follows "serial:". Errors: as knurl_device_open(). */
knurl_result knurl_serial_open(const char *options, const knurl_serial_ports *ports, knurl_device **device);

#endif

/* WoodenHaptics with the makers' Teensy 4.0 firmware (woody_teensy_mini, 2026): text over a USB serial port, one line
 * in each direction every millisecond. To the device: motor currents in mA, "[a,b,c]\n". From it:
 * "[model,enc0,...,enc5,error]\n"; its button sets the encoders to 0. It switches its motors off 100 ms after the last
 * line. The port is presented to the driver as a HID device with reports of 14 bytes. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_RAWHID_SERIAL_H
#define KNURL_SRC_RAWHID_SERIAL_H

#include "device/driver.h"
#include "device/rawhid/transport.h"

#define KNURL_SERIAL_VENDOR  0x16c0 /* Teensy, USB type "Serial" */
#define KNURL_SERIAL_PRODUCT 0x0483

/* An open serial port. [one thread at a time] */
typedef struct knurl_serial_wire {
    void *self;
    int (*write)(void *self, const char *text, size_t size); /* 1 if all of it was sent, otherwise 0 */
    /* Reads received bytes, at most `room`; 0: nothing within `milliseconds`; -1: the port is gone. */
    int (*read)(void *self, char *text, size_t room, int milliseconds);
    void (*close)(void *self);
} knurl_serial_wire;

/* Access to serial ports. */
typedef struct knurl_serial_ports {
    void *user;
    /* Finds the first Teensy's path: returns 1, or 0 if there is no Teensy. */
    int (*find)(void *user, char *path, size_t size);
    /* Returns 1, or 0 and the reason. */
    int (*open)(void *user, const char *path, knurl_serial_wire *wire, char *why, size_t why_size);
} knurl_serial_ports;

#if defined(_WIN32)
#define KNURL_SERIAL_EXAMPLE "COM3"
#elif defined(__APPLE__)
#define KNURL_SERIAL_EXAMPLE "/dev/cu.usbmodem1101"
#else
#define KNURL_SERIAL_EXAMPLE "/dev/ttyACM0"
#endif

/* The system's serial ports. */
const knurl_serial_ports *knurl_serial_system(void);

/* A serial port as a bus for the driver. */
typedef struct knurl_serial_bus {
    knurl_rawhid_bus bus;
    const knurl_serial_ports *ports;
    char path[KNURL_URI_ROOM];
    int16_t home[3];   /* counts in the home pose, in which the device's own are 0 */
    uint32_t is_again; /* 1: it was open before, and lost its power when unplugged */
} knurl_serial_bus;

/* `path`: "" for the first Teensy. */
void knurl_serial_bus_init(knurl_serial_bus *bus, const knurl_serial_ports *ports, const char *path,
                           const int16_t home[3]);

/* options: the URI after "serial:". Errors: as knurl_device_open(). */
knurl_result knurl_serial_open(const char *options, const knurl_serial_ports *ports, knurl_device **device);

#endif

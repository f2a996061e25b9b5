/* Internals of the raw HID driver. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_RAWHID_DEVICE_H
#define KNURL_SRC_RAWHID_DEVICE_H

#include "device/link.h"
#include "device/rawhid/choose.h"
#include "device/rawhid/kinematics.h"
#include "device/rawhid/serial.h"

typedef struct rawhid {
    knurl_device base;
    knurl_link link;
    const knurl_rawhid_bus *bus;
    knurl_serial_bus serial; /* if on a serial port; `ports` is null on USB HID */
    knurl_rawhid_port port;  /* self is null if closed */
    knurl_rawhid_geometry geometry;
    knurl_rawhid_arm arm;
    knurl_rawhid_wanted wanted;
    size_t report_bytes;
    int16_t home[3];
    uint32_t home_on_open;
    uint32_t motors_known;
    uint32_t wants_guard;
    /* of the I/O thread */
    double angles[3];
    uint32_t knows_angles;
    uint32_t is_lost; /* 1: the counters are wrong until it is homed; reported */
    uint32_t strange; /* impossible poses in a row */
    uint32_t hold;    /* exchanges still to come without a position */
} rawhid;

/* exchange.c. Outcome of a read. */
enum { RAWHID_GONE = -1, RAWHID_NOTHING = 0, RAWHID_REPORT = 1, RAWHID_BAD = 2 };

/* Discards reports that came too late to answer the next one sent. Returns 0 if the device is gone. */
int knurl_rawhid_drain(rawhid *r);

/* Waits up to `ns` for a valid report. Returns RAWHID_, but not RAWHID_BAD. */
int knurl_rawhid_await(rawhid *r, int64_t ns, knurl_rawhid_in *in);

/* Returns 0 if nothing was sent. */
int knurl_rawhid_send_currents(rawhid *r, const double force[3]);
int knurl_rawhid_send_home(rawhid *r);

/* For knurl_link_open(). */
int knurl_rawhid_exchange(knurl_device *device, const double force[3], knurl_device_sample *sample);

#endif

/* Internals of the raw HID driver. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_RAWHID_DEVICE_H
#define KNURL_SRC_RAWHID_DEVICE_H

#include "device/driver.h"
#include "device/link.h"
#include "device/rawhid/geometry.h"
#include "device/rawhid/kinematics.h"
#include "device/rawhid/serial.h"
#include "device/rawhid/transport.h"

/* Search criteria. */
typedef struct knurl_rawhid_wanted {
    uint16_t vendor, product; /* 0, 0: any known device */
    uint16_t usage_page, usage;
    size_t report_bytes; /* 0: as the report descriptor has it, or the known device */
} knurl_rawhid_wanted;

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

/* choose.c. Sets the criteria from `id` ("" or "VID:PID"), which overrides the geometry. Errors: KNURL_ERROR_ARGUMENT.
 */
knurl_result knurl_rawhid_want(const char *id, const knurl_rawhid_geometry *geometry, knurl_rawhid_wanted *wanted);

/* Finds the first interface that fits, and its report length. Errors: KNURL_ERROR_DEVICE_LOST, KNURL_ERROR_SYSTEM. */
knurl_result knurl_rawhid_choose(const knurl_rawhid_bus *bus, const knurl_rawhid_wanted *wanted,
                                 knurl_rawhid_found *chosen, size_t *report_bytes);

/* Lists all known devices; if no device is connected, adds one entry with the reason. */
void knurl_rawhid_list(const knurl_rawhid_bus *bus, knurl_listings *listings);

#endif

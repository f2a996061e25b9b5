/* The interface that each driver implements, and functions for all drivers. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_DRIVER_H
#define KNURL_SRC_DRIVER_H

#include "base/handle.h"
#include "base/seqlock.h"
#include "device/events.h"
#include "device/motor_check.h"
#include "device/motors.h"

#include <stdlib.h>

/* Numbers that a device plays: N along x, y, z, N m about them, N of a gripper. A driver may read only the forces. */
#define KNURL_FORCES 7

/* A list of devices: counts all, stores as many as fit. */
typedef struct knurl_listings {
    knurl_device_listing *to;
    uint32_t capacity;
    uint32_t count;
} knurl_listings;

typedef struct knurl_driver {
    const char *uri;     /* a URI's part before ':' */
    uint32_t keeps_heat; /* 1: a newly opened device inherits the heat of the last closed one of its kind */
    /* Lists connected devices; if there is no device, adds one entry with the reason. [game thread] */
    void (*list)(knurl_listings *listings);
    /* options: the URI after "uri:", or "". Calls knurl_device_allocate() and sets max_force; the device can then be
     * started. Errors: as knurl_device_open(). */
    knurl_result (*open)(const char *options, knurl_device **device);
    /* Sets the force to zero unless it is already; ends with knurl_device_free(). */
    void (*close)(knurl_device *device);
    /* Fills in `info`, which is preset: limits infinite, heat_time 60 s, all other fields 0. */
    void (*get_info)(const knurl_device *device, knurl_device_info *info);
    /* Null if the driver adds nothing to the common fields. */
    void (*get_status)(const knurl_device *device, knurl_device_status *status);
    /* These three are null if an I/O thread does the work (link.h). */
    knurl_result (*start)(knurl_device *device, double update_rate_hz);
    /* KNURL_OK, KNURL_ERROR_DEVICE_LOST, or KNURL_ERROR_DEVICE_NOT_READY after the driver has reported the reason */
    knurl_result (*read)(knurl_device *device, knurl_device_sample *sample);
    knurl_result (*write)(knurl_device *device, const double force[KNURL_FORCES]);
    /* Reopens a lost device; null if not supported. Never called during a read or write. */
    knurl_result (*reopen)(knurl_device *device);
    /* For a driver that owns the servo thread: calls `tick` from there once a period of the started rate until it
     * returns 0, and never after that; read and write work inside `tick`. If the device is lost, `tick` is called once
     * more, then not before reopen() succeeds. If null, the loop runs a thread of its own. */
    knurl_result (*serve)(knurl_device *device, uint32_t (*tick)(void *argument), void *argument);
    /* Called if `tick` has not run for long: prevents further calls until reopen() and returns 1, or returns 0 if a
     * call is in progress. Null if serve is null. [not the haptic thread] */
    uint32_t (*leave)(knurl_device *device);
} knurl_driver;

/* State of the plausibility check: each position against the last one. */
typedef struct knurl_position_check {
    double last[3];   /* m */
    double gap;       /* s since `last` */
    double least_gap; /* s: shorter gaps count as this */
    double settle;    /* s that positions must still pass before they count again */
    uint32_t has_last;
    uint32_t not_finite; /* 1: already reported */
} knurl_position_check;

/* Bits of knurl_device.use: claimed by a loop; that loop has started its haptic thread; closed by its owner, but kept
 * until the loop releases it. */
#define KNURL_DEVICE_LOOP   1u
#define KNURL_DEVICE_THREAD 2u
#define KNURL_DEVICE_CLOSED 4u

/* Bits of knurl_device.halted: until knurl_port_release_halt(); closed; a motor runs backwards, until closed. */
#define KNURL_HALTED           1u
#define KNURL_HALTED_FOR_GOOD  2u
#define KNURL_HALTED_BACKWARDS 4u

/* First member of every driver's own struct. */
struct knurl_device {
    uint32_t handle; /* KNURL_HANDLE_DEVICE, first */
    const knurl_driver *driver;
    double max_force;        /* N */
    double max_torque;       /* N m; 0: its driver plays no torques */
    double max_grip;         /* N: the same */
    double torque[4];        /* N m, N: for the next write, which clears it; of the haptic thread */
    double max_speed;        /* m/s: faster than any hand; 0 if positions may jump (the fake device plays traces) */
    double period;           /* s, of the last start */
    struct knurl_link *link; /* I/O thread, see link.h; null if the driver transfers directly */
    knurl_position_check check;
    knurl_motor_check motor_check; /* used by drivers whose motors may be wired or signed backwards */
    knurl_events events;
    knurl_motor_heat motors; /* read by the thread that starts a loop, written by the one that ends it */
    /* atomics */
    uintptr_t thread;                     /* haptic thread of the last loop that started one */
    uint32_t use;                         /* KNURL_DEVICE_ bits */
    uint32_t halted;                      /* KNURL_HALTED bits */
    uint32_t lost;                        /* 1: only reopen() may call the driver */
    uint32_t quiet;                       /* 1: the last force sent was 0, and no transfer is in progress */
    uint32_t buttons;                     /* of the last reading */
    double battery;                       /* as knurl_device_status; of the last reading */
    KNURL_SEQLOCK(double[5]) orientation; /* with the gripper's angle */
};

/* Sets up a driver's zeroed device. */
static inline void knurl_device_init(knurl_device *device, const knurl_driver *driver) {
    device->handle = KNURL_HANDLE_DEVICE;
    device->driver = driver;
}

/* Allocates a driver's own struct of `size` bytes, zeroed except handle, driver and max_speed (KNURL_HAND_SPEED). Null,
 * with a message, if there is no memory: KNURL_ERROR_MEMORY. */
void *knurl_device_allocate(const knurl_driver *driver, size_t size);

static inline void knurl_device_free(knurl_device *device) {
    knurl_handle_clear(&device->handle);
    free(device);
}

/* Sets the workspace to the largest cube within a sphere of `radius` (m) around the device's origin. */
void knurl_device_info_sphere(knurl_device_info *info, double radius);

/* The device's properties. Checked, so that a number out of its range never reaches a limit, a protection or a period.
 * Errors: KNURL_ERROR_ARGUMENT (which, expected, found). */
knurl_result knurl_device_ask(const knurl_device *device, knurl_device_info *info);

/* The end of a driver's open(): if `result` is KNURL_OK, starts the device at 1 kHz and returns it in *opened. If that
 * or the start fails, closes it with the driver's close(). */
knurl_result knurl_device_finish_open(knurl_device *device, knurl_result result, knurl_device **opened);

/* m/s: faster than a hand that holds a device. */
#define KNURL_HAND_SPEED 10.0

/* s of plausible positions after an implausible one before positions count again. */
#define KNURL_SETTLE_TIME 0.02

/* KNURL_OK if no KNURL_DEVICE_ bit of `use` is set; otherwise KNURL_ERROR_STATE with a message. */
knurl_result knurl_device_check_unused(const knurl_device *device, uint32_t use);

/* 1 if the process is ending or stopping, so that no force may be sent (exit.c). [any thread] */
uint32_t knurl_device_must_be_zero(void);

/* Called before and after each send, on the sending thread. The device is not quiet from before a force is sent until a
 * zero has been sent. If the device is halted or the process is ending, before_force zeroes the force. */
void knurl_device_before_force(knurl_device *device, double force[KNURL_FORCES]);
void knurl_device_after_force(knurl_device *device, const double force[KNURL_FORCES]);

/* 1 if all of its numbers are 0. */
int knurl_force_is_zero(const double force[KNURL_FORCES]);

/* Open devices, for exit.c. [game thread] */
void knurl_device_register(knurl_device *device);
void knurl_device_unregister(knurl_device *device);

/* The drivers; find.c lists them. */
extern const knurl_driver knurl_fake_driver;
extern const knurl_driver knurl_touch_driver;
extern const knurl_driver knurl_falcon_driver;
extern const knurl_driver knurl_rawhid_driver;
extern const knurl_driver knurl_serial_driver;
extern const knurl_driver knurl_dhd_driver;
extern const knurl_driver knurl_inverse3_driver;

/* Advice in messages about devices that may not be opened. */
#ifdef __linux__
#define KNURL_PERMISSION_ADVICE                                                                                        \
    "copy sdk/udev/70-knurl.rules to /etc/udev/rules.d, run 'udevadm control --reload' and 'udevadm trigger', and "    \
    "plug it in again"
#else /* no rules are needed there */
#define KNURL_PERMISSION_ADVICE "end other programs that use it"
#endif

/* Appends a device. `reason`: printf format; "" if the device can be opened. */
void knurl_listings_add(knurl_listings *listings, const char *uri, const char *name, const char *reason, ...)
    KNURL_PRINTF(4, 5);

/* Bytes of each part of a URI, "driver:name?key=value&key=value". */
#define KNURL_URI_ROOM 512

/* A key that a driver accepts, and the buffer for its value (KNURL_URI_ROOM bytes; "" if the URI lacks it). */
typedef struct knurl_uri_key {
    const char *key;
    char *value;
} knurl_uri_key;

/* Splits `options` into a name (KNURL_URI_ROOM bytes, may be "") and values, without decoding. Errors:
 * KNURL_ERROR_ARGUMENT (an unknown key, no '=', too long), with the device and its keys. */
knurl_result knurl_uri_parse(const char *driver, const char *options, char *name, const knurl_uri_key *keys,
                             size_t key_count);

/* Parses a flag: "1", or "0" or "" for 0. Errors: KNURL_ERROR_ARGUMENT. */
knurl_result knurl_uri_flag(const char *driver, const char *key, const char *value, uint32_t *flag);

#endif

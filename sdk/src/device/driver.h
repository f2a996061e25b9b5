/* The interface that each driver implements. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_DRIVER_H
#define KNURL_SRC_DRIVER_H

#include "base/handle.h"
#include "base/seqlock.h"
#include "device/events.h"
#include "device/motor_check.h"
#include "device/motors.h"

#include <stdlib.h>

/* A list of devices: counts all, stores as many as fit. */
typedef struct knurl_listings {
    knurl_device_listing *to;
    uint32_t capacity;
    uint32_t count;
} knurl_listings;

typedef struct knurl_driver {
    const char *uri;     /* a URI's part before ':' */
    uint32_t keeps_heat; /* 1: an opened device starts with the heat of the last closed one of its kind */
    /* Lists connected devices; at least one entry, with a reason if there is none. [game thread] */
    void (*list)(knurl_listings *listings);
    /* options: what follows "uri:", or "". Makes a zeroed knurl_device with knurl_device_init() and max_force set,
     * ready to be started. Errors: as knurl_device_open(). */
    knurl_result (*open)(const char *options, knurl_device **device);
    /* The force has been set to zero, or is now; ends with knurl_device_free(). */
    void (*close)(knurl_device *device);
    /* info: no limits but max_force, which is 0. */
    void (*get_info)(const knurl_device *device, knurl_device_info *info);
    /* Null if the driver adds nothing to the common fields. */
    void (*get_status)(const knurl_device *device, knurl_device_status *status);
    /* These three are null if an I/O thread does the work (link.h). */
    knurl_result (*start)(knurl_device *device, double update_rate_hz);
    /* KNURL_OK, KNURL_ERROR_DEVICE_LOST, KNURL_ERROR_DEVICE_NOT_READY (the driver has reported why) */
    knurl_result (*read)(knurl_device *device, knurl_device_sample *sample);
    knurl_result (*write)(knurl_device *device, const double force[3]);
    /* Reopens a lost device; null: not supported. Never called during a read or write. */
    knurl_result (*reopen)(knurl_device *device);
    /* A driver that owns the servo thread: from there it calls `tick` once a period of the started rate, until that
     * returns 0, and never afterwards; read and write work inside of it. When the device gets lost, `tick` is called
     * once more, then not before reopen() succeeds. Null: the loop has a thread of its own. */
    knurl_result (*serve)(knurl_device *device, uint32_t (*tick)(void *argument), void *argument);
    /* When `tick` has not been called for long: sees to it that it is not called again before reopen(), and returns 1;
     * or 0 where a call is under way. Null where serve is. [not the haptic thread] */
    uint32_t (*leave)(knurl_device *device);
} knurl_driver;

/* Checks each position against the last one. */
typedef struct knurl_position_check {
    double last[3];   /* m */
    double gap;       /* s since then */
    double least_gap; /* s */
    double settle;    /* s: positions must pass for so long before they count again */
    uint32_t has_last;
    uint32_t not_finite; /* 1: reported */
} knurl_position_check;

/* Bits of knurl_device.use: a loop has it; that loop has started its haptic thread; its owner has closed it, and it is
 * kept for that loop. */
#define KNURL_DEVICE_LOOP   1u
#define KNURL_DEVICE_THREAD 2u
#define KNURL_DEVICE_CLOSED 4u

/* Bits of knurl_device.halted: until knurl_device_release_halt(); closed; a motor is backwards, until it is closed. */
#define KNURL_HALTED           1u
#define KNURL_HALTED_FOR_GOOD  2u
#define KNURL_HALTED_BACKWARDS 4u

/* First member of every driver's own struct; zeroed but for handle, driver and max_force. */
struct knurl_device {
    uint32_t handle; /* KNURL_HANDLE_DEVICE, first */
    const knurl_driver *driver;
    double max_force;        /* N */
    double max_speed;        /* m/s: faster than any hand; 0: positions may jump (the fake device plays traces) */
    double period;           /* s, of the latest start */
    struct knurl_link *link; /* the I/O thread that exchanges, see link.h; null: there is none */
    knurl_position_check check;
    knurl_motor_check motor_check; /* begun by drivers whose motors may be wired or signed backwards */
    knurl_events events;
    knurl_motor_heat motors; /* a thread that starts a loop reads it, one that ends it writes it */
    /* atomics */
    uintptr_t thread; /* the haptic thread of the latest loop that has started one */
    uint32_t use;     /* KNURL_DEVICE_ bits */
    uint32_t halted;  /* KNURL_HALTED bits */
    uint32_t lost;    /* 1: only reopen() may call the driver */
    uint32_t quiet;   /* 1: the latest force sent was 0, and no transfer is under way */
    uint32_t buttons; /* of the latest reading */
    KNURL_SEQLOCK(double[4]) orientation;
};

/* Sets up a driver's zeroed device. */
static inline void knurl_device_init(knurl_device *device, const knurl_driver *driver) {
    device->handle = KNURL_HANDLE_DEVICE;
    device->driver = driver;
}

/* Frees a driver's own struct, from calloc(). */
static inline void knurl_device_free(knurl_device *device) {
    knurl_handle_clear(&device->handle);
    free(device);
}

/* Its properties, checked: a number that is out of its range must not reach a limit, a protection or a period. Errors:
 * KNURL_ERROR_ARGUMENT (which, expected, found). */
knurl_result knurl_device_ask(const knurl_device *device, knurl_device_info *info);

/* The end of a driver's open(): starts its device at 1 kHz, where `result` is KNURL_OK, and hands it out; else, and
 * where it does not start, closes it by the driver. */
knurl_result knurl_device_finish_open(knurl_device *device, knurl_result result, knurl_device **opened);

/* m/s: faster than a hand that holds a device. */
#define KNURL_HAND_SPEED 10.0

/* s: after an implausible position, how long positions must be plausible before they count again. */
#define KNURL_SETTLE_TIME 0.02

/* KNURL_OK if none of the KNURL_DEVICE_ bits in `use` is set; else KNURL_ERROR_STATE with a message. */
knurl_result knurl_device_check_unused(const knurl_device *device, uint32_t use);

/* 1: the process is about to end or to stop, and no force may go out (exit.c). [any thread] */
uint32_t knurl_device_must_be_zero(void);

/* Called before and after sending a force, on the sending thread. The device is not quiet from before a force is sent
 * until a zero was sent. While the device is halted or the process ends every force becomes zero. */
void knurl_device_before_force(knurl_device *device, double force[3]);
void knurl_device_after_force(knurl_device *device, const double force[3]);

/* Open devices, for exit.c. [game thread] */
void knurl_device_register(knurl_device *device);
void knurl_device_unregister(knurl_device *device);

#endif

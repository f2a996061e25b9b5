/* The I/O thread of a device whose transfers block. The haptic thread posts the newest force and takes the newest
 * position; neither thread waits for the other.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_LINK_H
#define KNURL_SRC_LINK_H

#include "base/guard_process.h"
#include "base/histogram.h"
#include "base/mailbox.h"
#include "base/system.h"
#include "device/driver.h"

/* Outcome of an exchange. */
enum {
    KNURL_LINK_POSITION,    /* position received */
    KNURL_LINK_NO_POSITION, /* the device answered without a position (the driver reports why) */
    KNURL_LINK_OFF, /* the device answered that it plays no force, or that its position is unknown (reported): earlier
                       positions are void, and no force is sent until a position arrives */
    KNURL_LINK_NOTHING, /* no answer in time */
    KNURL_LINK_LOST     /* device lost */
};

/* Sends a force (device axes, finite, within the device's limits) and waits up to 5 ms for a position. KNURL_LINK_. */
typedef int (*knurl_link_exchange)(knurl_device *device, const double force[KNURL_FORCES], knurl_device_sample *sample);

/* s: an older force is not sent again, and silence this long is a fault: ten exchanges at 1 kHz. */
#define KNURL_LINK_PATIENCE 0.01

/* s of silence after which a device counts as lost. */
#define KNURL_LINK_GIVE_UP 1.0

typedef struct knurl_link {
    knurl_device *device;
    knurl_link_exchange exchange;
    double native_rate; /* Hz: the highest rate of exchanges */
    knurl_thread *thread;
    knurl_guard_process *guard; /* running from before the thread until after it; may be null */
    uint64_t patience;          /* reads for which the last position stays valid */
    /* to the haptic thread */
    knurl_mailbox positions;
    knurl_device_sample samples[3];
    uint64_t stale;   /* reads since the last position; these four belong to the haptic thread */
    uint64_t stuck;   /* reads since the I/O thread's last cycle */
    uint64_t watched; /* `cycles` at the last read */
    uint32_t has_sample;
    /* from the haptic thread */
    knurl_mailbox orders;
    struct {
        double force[KNURL_FORCES];
        int64_t time_ns;
    } forces[3];
    /* of the I/O thread */
    int64_t heard_at;
    int64_t told_guard_at;
    uint32_t is_late;      /* 1: already reported */
    uint32_t is_unguarded; /* 1: already reported */
    uint32_t is_corrupt;   /* 1: already reported; cleared by the driver, with a valid message */
    int32_t trouble;       /* KNURL_FAULT_ why the device plays no forces, reported; 0 if it plays them */
    /* atomics */
    uint32_t is_silent; /* 1: already reported, by either thread */
    uint32_t is_off;    /* the last exchange ended with KNURL_LINK_OFF */
    uint32_t stop;
    uint32_t lost;
    uint32_t realtime;  /* 1: the thread is under the real-time scheduler */
    uint64_t cycles;    /* of the I/O thread */
    uint64_t exchanges; /* with a position */
    uint64_t bad_bytes;
    knurl_histogram durations;
} knurl_link;

/* Starts the I/O thread and sets device->link; `link` is zeroed, or was closed. Errors: KNURL_ERROR_SYSTEM. */
knurl_result knurl_link_open(knurl_link *link, knurl_device *device, knurl_link_exchange exchange, double native_rate);

/* Ends the thread after it has sent a zero force, and the guard process. No effect on a zeroed link. */
void knurl_link_close(knurl_link *link);

/* Starts the guard process, before the thread. shared: a descriptor of the device, closed by the guard; -1: this system
 * cannot share one. Errors: KNURL_ERROR_UNSUPPORTED. */
knurl_result knurl_link_start_guard(knurl_link *link, const knurl_device *device, int shared,
                                    const knurl_guard_order *order);

/* For exchanges. Counts bytes that form no message; the first of several in a row are reported. */
void knurl_link_count_bad(knurl_link *link, knurl_device *device, uint64_t bytes);

/* For exchanges of a device that reports why it plays no forces: trouble, 0 or a KNURL_FAULT_, is reported once, with
 * `cause` as its value. Returns KNURL_LINK_POSITION, or KNURL_LINK_OFF. */
int knurl_link_take_trouble(knurl_link *link, int32_t trouble, int32_t cause);

/* The driver functions of a device with a link. */
void knurl_link_start(knurl_link *link, double update_rate_hz);
knurl_result knurl_link_read(knurl_link *link, knurl_device_sample *sample);
knurl_result knurl_link_write(knurl_link *link, const double force[KNURL_FORCES]);
void knurl_link_get_status(const knurl_link *link, knurl_device_status *status);

#endif

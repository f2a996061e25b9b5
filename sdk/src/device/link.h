/* The I/O thread of a device whose transfers block. The haptic thread leaves the newest force there and takes the
 * newest position; neither waits for the other.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_LINK_H
#define KNURL_SRC_LINK_H

#include "base/guard_process.h"
#include "base/histogram.h"
#include "base/mailbox.h"
#include "base/system.h"
#include "device/driver.h"

/* How an exchange ended. */
enum {
    KNURL_LINK_POSITION,    /* a position came */
    KNURL_LINK_NO_POSITION, /* the device answers without a position (reported by the driver) */
    KNURL_LINK_OFF,     /* it answers that it plays no force now, or does not know where it is (reported): no earlier
                           position holds, and no force goes out until a position comes */
    KNURL_LINK_NOTHING, /* no answer in time */
    KNURL_LINK_LOST     /* it is gone */
};

/* Sends a force (N, device axes, finite, at most max_force) and waits for a position, 5 ms at most. KNURL_LINK_. */
typedef int (*knurl_link_exchange)(knurl_device *device, const double force[3], knurl_device_sample *sample);

/* s: a force older than this is not sent again, and silence for as long is a fault: ten exchanges at 1 kHz. */
#define KNURL_LINK_PATIENCE 0.01

/* s of silence after which a device counts as lost. */
#define KNURL_LINK_GIVE_UP 1.0

typedef struct knurl_link {
    knurl_device *device;
    knurl_link_exchange exchange;
    double native_rate; /* Hz: the highest rate of exchanges */
    knurl_thread *thread;
    knurl_guard_process *guard; /* null: none; the driver's, which starts it before and stops it after the thread */
    uint64_t patience;          /* reads for which the latest position holds */
    /* to the haptic thread */
    knurl_mailbox positions;
    knurl_device_sample samples[3];
    uint64_t stale;   /* reads since the latest position; these four are the haptic thread's */
    uint64_t stuck;   /* reads since the latest turn of the I/O thread */
    uint64_t watched; /* `cycles` at the latest read */
    uint32_t has_sample;
    /* from the haptic thread */
    knurl_mailbox orders;
    struct {
        double force[3];
        int64_t time_ns;
    } forces[3];
    /* the I/O thread's */
    int64_t heard_at;
    int64_t told_guard_at;
    uint32_t is_late;      /* reported */
    uint32_t is_unguarded; /* reported */
    /* atomics */
    uint32_t is_silent; /* reported, by either thread */
    uint32_t is_off;    /* the latest exchange ended by KNURL_LINK_OFF */
    uint32_t stop;
    uint32_t lost;
    uint64_t cycles;    /* of the I/O thread */
    uint64_t exchanges; /* that brought a position */
    knurl_histogram durations;
} knurl_link;

/* Starts the I/O thread; `link` is zeroed, or was closed. Sets device->link. Errors: KNURL_ERROR_SYSTEM. */
knurl_result knurl_link_open(knurl_link *link, knurl_device *device, knurl_link_exchange exchange, double native_rate);

/* Ends the thread, whose last exchanges carry no force. A link that was never opened is fine. */
void knurl_link_close(knurl_link *link);

/* The driver's functions, done by the link. */
void knurl_link_start(knurl_link *link, double update_rate_hz);
knurl_result knurl_link_read(knurl_link *link, knurl_device_sample *sample);
knurl_result knurl_link_write(knurl_link *link, const double force[3]);
void knurl_link_get_status(const knurl_link *link, knurl_device_status *status);

#endif

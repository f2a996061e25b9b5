/* A device's events: a ring that any thread writes without waiting; the latest are kept.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_EVENTS_H
#define KNURL_SRC_EVENTS_H

#include "base/finite.h"

#include <knurl/device.h>

#define KNURL_EVENT_ROOM 64

typedef struct knurl_events {
    uint64_t head; /* atomic: written so far */
    uint64_t next; /* the reader's */
    struct {
        uint64_t sequence; /* atomic: 2 * number + 2 when whole, odd while it is written */
        uint64_t dropped;  /* atomic: number + 1 of the latest that found the slot taken */
        int64_t time_ns;   /* these three as atomics */
        double value;
        int32_t code;
    } slots[KNURL_EVENT_ROOM];
} knurl_events;

/* Adds an event with the present time. Zeroed memory is an empty ring. [any thread] */
void knurl_events_report(knurl_events *events, int32_t code, double value);

/* The next one: 1, or 0 where there is none. [one thread] */
uint32_t knurl_events_next(knurl_events *events, knurl_device_event *event);

#endif

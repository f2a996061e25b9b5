/* A device's events: a ring that any thread can write without waiting; keeps the last KNURL_EVENT_ROOM.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_EVENTS_H
#define KNURL_SRC_EVENTS_H

#include "base/finite.h"

#include <knurl/device.h>

#define KNURL_EVENT_ROOM 64

typedef struct knurl_events {
    uint64_t head; /* atomic: events written so far */
    uint64_t next; /* next to read */
    struct {
        uint64_t sequence; /* atomic: 2 * number + 2 when complete, odd during a write */
        uint64_t dropped;  /* atomic: 1 + number of the last event dropped because the slot was taken */
        int64_t time_ns;   /* accessed as atomics, like the next two */
        double value;
        int32_t code;
    } slots[KNURL_EVENT_ROOM];
} knurl_events;

/* Adds an event, stamped with the current time. Zeroed memory is an empty ring. [any thread] */
void knurl_events_report(knurl_events *events, int32_t code, double value);

/* Reads the next event: returns 1, or 0 if there is no event. [one thread] */
uint32_t knurl_events_next(knurl_events *events, knurl_device_event *event);

#endif

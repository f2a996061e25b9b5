/* One T3 event, for callers inside a tick: no checks, no messages, inlined. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_EVENT_H
#define KNURL_SRC_EVENT_H

#include <knurl/vibration.h>

/* Algorithm 5's six values in units of A (event.c). */
extern const double knurl_mixed_heights[6];

/* knurl_vibration_event_prepare() without checks: 0 <= period_ticks <= KNURL_MAX_PERIOD_TICKS, amplitude finite and >=
 * 0. */
void knurl_vibration_event_fill(double period_ticks, double amplitude, knurl_vibration_event *event) KNURL_NONBLOCKING;

/* knurl_vibration_event_value() of an event that is not mixed. */
static inline double knurl_vibration_event_level(const knurl_vibration_event *event, int32_t index) {
    return index < event->positive_ticks ? event->positive : -event->negative;
}

/* knurl_vibration_event_height() for 0 <= index < event->length. */
static inline double knurl_vibration_event_value(const knurl_vibration_event *event, int32_t index) {
    if (event->kind == KNURL_EVENT_MIXED) {
        return event->positive * knurl_mixed_heights[index];
    }
    return knurl_vibration_event_level(event, index);
}

#endif

/* The event ring and the names of faults. SPDX-License-Identifier: MIT */
#include "device/events.h"

#include "base/atomic.h"
#include "base/system.h"

/* Only one writer at a time may hold a slot. A writer drops its event if the ring has overtaken it or if another one
 * still holds the slot: it must not wait, and two at once would write a torn event. */
void knurl_events_report(knurl_events *events, int32_t code, double value) {
    const uint64_t number = __atomic_fetch_add(&events->head, 1, __ATOMIC_RELAXED);
    const size_t at = number % KNURL_EVENT_ROOM;
    uint64_t found = knurl_load_acquire(&events->slots[at].sequence);
    if (found % 2 != 0 || found > 2 * number ||
        !__atomic_compare_exchange_n(&events->slots[at].sequence, &found, 2 * number + 1, 0, __ATOMIC_ACQ_REL,
                                     __ATOMIC_RELAXED)) {
        knurl_store_release(&events->slots[at].dropped, number + 1);
        return;
    }
    __atomic_store_n(&events->slots[at].time_ns, knurl_system_now_ns(), __ATOMIC_RELEASE);
    __atomic_store(&events->slots[at].value, &value, __ATOMIC_RELEASE);
    __atomic_store_n(&events->slots[at].code, code, __ATOMIC_RELEASE);
    knurl_store_release(&events->slots[at].sequence, 2 * number + 2);
}

/* Reads event number `next`; 0 if its slot was reused or is being written. */
static int read_slot(knurl_events *events, knurl_device_event *event) {
    const size_t at = events->next % KNURL_EVENT_ROOM;
    const uint64_t whole = 2 * events->next + 2;
    if (knurl_load_acquire(&events->slots[at].sequence) != whole) {
        return 0;
    }
    event->time_ns = knurl_load_acquire(&events->slots[at].time_ns);
    __atomic_load(&events->slots[at].value, &event->value, __ATOMIC_ACQUIRE);
    event->code = knurl_load_acquire(&events->slots[at].code);
    event->reserved = 0;
    return knurl_load_relaxed(&events->slots[at].sequence) == whole;
}

/* 1 if event number `next` is still to be written, or is complete by now. */
static int is_on_its_way(const knurl_events *events) {
    const size_t at = events->next % KNURL_EVENT_ROOM;
    return knurl_load_acquire(&events->slots[at].sequence) <= 2 * events->next + 2 &&
           knurl_load_acquire(&events->slots[at].dropped) != events->next + 1;
}

uint32_t knurl_events_next(knurl_events *events, knurl_device_event *event) {
    knurl_device_event found;
    const uint64_t head = knurl_load_acquire(&events->head);
    if (head - events->next > KNURL_EVENT_ROOM) {
        events->next = head - KNURL_EVENT_ROOM;
    }
    while (events->next < head) { /* 64 times at most */
        if (read_slot(events, &found)) {
            events->next++;
            *event = found;
            return 1;
        }
        if (is_on_its_way(events)) {
            return 0; /* retry on the next call */
        }
        events->next++; /* overwritten, or dropped */
    }
    return 0;
}

static const struct {
    int32_t code;
    const char *name, *text, *unit;
} faults[] = {
#define KNURL_FAULT_ROW(constant, number, name, text, unit) {constant, name, text, unit},
    KNURL_FAULTS(KNURL_FAULT_ROW)
#undef KNURL_FAULT_ROW
        {0, "unknown", "a fault unknown to this version", ""}};

#define FAULT_COUNT (sizeof faults / sizeof *faults - 1)

/* Index of the code's row; the last row if the code is unknown. */
static size_t find(int32_t code) {
    size_t i = 0;
    while (i < FAULT_COUNT && faults[i].code != code) {
        i++;
    }
    return i;
}

const char *knurl_fault_name(int32_t code) {
    return faults[find(code)].name;
}

const char *knurl_fault_string(int32_t code) {
    return faults[find(code)].text;
}

const char *knurl_fault_unit(int32_t code) {
    return faults[find(code)].unit;
}

const char *knurl_fault_cause(int32_t code, double value) {
    static const char *const causes[] = {
#define KNURL_CAUSE(constant, number, text) [number] = (text),
        KNURL_FORCE_OFF_CAUSES(KNURL_CAUSE)
#undef KNURL_CAUSE
    };
    const size_t count = sizeof causes / sizeof *causes;
    if (code != KNURL_FAULT_FORCE_OFF) {
        return "";
    }
    return value > 0.0 && value < (double)count ? causes[(size_t)value] : causes[KNURL_FORCE_OFF_UNTOLD];
}

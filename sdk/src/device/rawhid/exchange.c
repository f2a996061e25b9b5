/* Exchanges with a raw HID device: a report with motor currents, answered by one with encoder counts. Read
 * knurl_rawhid_exchange() first. SPDX-License-Identifier: MIT */
#include "device/rawhid/rawhid_device.h"

#define ANSWER_NS     4000000 /* to wait for a report: an exchange takes 5 ms at most */
#define QUEUE_ROOM    64      /* reports that the kernel queues */
#define STRANGE_LIMIT 3       /* impossible poses in a row after which the counters are not trusted */
#define HOLD_CYCLES   50 /* exchanges without a position after homing: the loop zeroes the force first, then ramps */

static int take_report(rawhid *r, int milliseconds, knurl_rawhid_in *in) {
    uint8_t bytes[KNURL_RAWHID_MOST_BYTES + 1]; /* one more, to detect a report that is too long */
    const int got = r->port.read(r->port.self, bytes, sizeof bytes, milliseconds);
    if (got <= 0) {
        return got < 0 ? RAWHID_GONE : RAWHID_NOTHING;
    }
    if (knurl_rawhid_parse(bytes, (size_t)got, r->report_bytes, in)) {
        r->link.is_corrupt = 0;
        return RAWHID_REPORT;
    }
    knurl_link_count_bad(&r->link, &r->base, (uint64_t)got);
    return RAWHID_BAD;
}

int knurl_rawhid_drain(rawhid *r) {
    knurl_rawhid_in ignored;
    int outcome = RAWHID_REPORT;
    for (int i = 0; i < QUEUE_ROOM && outcome > RAWHID_NOTHING; i++) {
        outcome = take_report(r, 0, &ignored);
    }
    return outcome != RAWHID_GONE;
}

int knurl_rawhid_await(rawhid *r, int64_t ns, knurl_rawhid_in *in) {
    const int64_t until = knurl_system_now_ns() + ns;
    for (int i = 0; i < QUEUE_ROOM; i++) {
        const int64_t left = until - knurl_system_now_ns();
        const int outcome = take_report(r, left > 0 ? (int)((left + 999999) / 1000000) : 0, in);
        if (outcome != RAWHID_BAD) {
            return outcome;
        }
    }
    return RAWHID_NOTHING;
}

int knurl_rawhid_send_currents(rawhid *r, const double force[3]) {
    uint8_t bytes[KNURL_RAWHID_MOST_BYTES + 1];
    int16_t ma[3] = {0, 0, 0};
    if (r->knows_angles) {
        knurl_rawhid_currents(&r->arm, r->angles, force, ma);
    }
    return r->port.write(r->port.self, bytes, knurl_rawhid_put_currents(bytes, r->report_bytes, ma));
}

int knurl_rawhid_send_home(rawhid *r) {
    uint8_t bytes[KNURL_RAWHID_MOST_BYTES + 1];
    return r->port.write(r->port.self, bytes, knurl_rawhid_put_counters(bytes, r->report_bytes, r->home));
}

/* The grip's position from its counters, unless they cannot be trusted. */
static int locate(rawhid *r, const knurl_rawhid_in *in, knurl_device_sample *sample) {
    if (in->info == 1) { /* its button was pressed: the grip is in the home pose */
        if (r->hold == 0 && !r->is_lost) {
            knurl_events_report(&r->base.events, KNURL_FAULT_UNCALIBRATED, 0.0);
        }
        r->knows_angles = 0;
        r->hold = HOLD_CYCLES;
        r->strange = r->is_lost = 0;
        (void)knurl_rawhid_send_home(r);
        return KNURL_LINK_NO_POSITION;
    }
    knurl_rawhid_angles(&r->arm, in->counts, r->angles);
    r->strange = knurl_rawhid_is_pose(&r->arm, r->angles) ? 0 : r->strange + 1;
    if (r->strange >= STRANGE_LIMIT && !r->is_lost) { /* until it is homed: it lost power, or was never homed */
        r->is_lost = 1;
        knurl_events_report(&r->base.events, KNURL_FAULT_UNCALIBRATED, 0.0);
    }
    r->hold -= r->hold > 0;
    r->knows_angles = r->strange == 0 && !r->is_lost && r->hold == 0;
    if (!r->knows_angles) {
        return KNURL_LINK_NO_POSITION;
    }
    knurl_rawhid_position(&r->arm, r->angles, sample->position);
    return KNURL_LINK_POSITION;
}

/* The firmware answers each report with one. The motor currents are computed for the arm's pose in the last exchange, a
 * millisecond ago. */
int knurl_rawhid_exchange(knurl_device *device, const double force[3], knurl_device_sample *sample) {
    rawhid *r = (rawhid *)(void *)device; /* first member */
    knurl_rawhid_in in;
    if (!knurl_rawhid_drain(r)) {
        return KNURL_LINK_LOST;
    }
    if (!knurl_rawhid_send_currents(r, force)) {
        knurl_rawhid_in ignored; /* only a read distinguishes a device that is gone from one that is busy */
        return take_report(r, 0, &ignored) == RAWHID_GONE ? KNURL_LINK_LOST : KNURL_LINK_NOTHING;
    }
    const int outcome = knurl_rawhid_await(r, ANSWER_NS, &in);
    return outcome == RAWHID_GONE     ? KNURL_LINK_LOST
           : outcome == RAWHID_REPORT ? locate(r, &in, sample)
                                      : KNURL_LINK_NOTHING;
}

/* The simulated bus. SPDX-License-Identifier: MIT */
#include "device/rawhid/fake_hid.h"

#include "support/close.h"
#include "support/double.h"

#include <stdio.h>

static double seconds(void) {
    return 1e-9 * (double)knurl_system_now_ns();
}

static void push(fake_hid *hid, const uint8_t *bytes, size_t size, int64_t due) {
    if (hid->head - hid->tail < FAKE_HID_QUEUE) { /* like the kernel: drops reports if the queue is full */
        const uint32_t at = hid->head++ % FAKE_HID_QUEUE;
        memcpy(hid->queue[at].bytes, bytes, size);
        hid->queue[at].size = size;
        hid->queue[at].due = due;
    }
}

void fake_hid_push(fake_hid *hid, const uint8_t *bytes, size_t size) {
    knurl_system_mutex_lock(&hid->mutex);
    push(hid, bytes, size, 0);
    knurl_system_mutex_unlock(&hid->mutex);
}

static void answer(fake_hid *hid) {
    uint8_t report[HID_SIM_MOST_BYTES];
    size_t size = hid->sim.report_bytes;
    hid_sim_say(&hid->sim, report);
    if (hid->fault == DOUBLE_CORRUPT) {
        for (size_t i = 0; i < size; i++) {
            report[i] = (uint8_t)random_bits(&hid->random);
        }
    }
    size = hid->fault == DOUBLE_SHORT ? 7 : size;
    push(hid, report, size, hid->fault == DOUBLE_LATE ? knurl_system_now_ns() + 20000000 : 0);
}

static int port_write(void *self, const uint8_t *bytes, size_t size) {
    fake_hid *hid = self;
    knurl_system_mutex_lock(&hid->mutex);
    const int hangs = hid->fault == DOUBLE_HANG;
    const int works = hid->fault != DOUBLE_UNPLUG && !hangs;
    if (works && size <= sizeof hid->last) {
        memcpy(hid->last, bytes, size);
        hid->last_size = size;
        hid->written++;
        uint8_t report[HID_SIM_MOST_BYTES + 1];
        memcpy(report, bytes, size);
        if (hid->ignores_commands) {
            report[7] = 0;
        }
        if (hid_sim_hear(&hid->sim, seconds(), report + 1, size - 1) && hid->fault != DOUBLE_MUTE) {
            answer(hid);
        }
    }
    knurl_system_mutex_unlock(&hid->mutex);
    if (hangs) {
        knurl_system_sleep_until_ns(knurl_system_now_ns() + 5000000);
    }
    return works;
}

static int take(fake_hid *hid, uint8_t *bytes, size_t room) {
    int got = 0;
    knurl_system_mutex_lock(&hid->mutex);
    if (hid->fault == DOUBLE_UNPLUG) {
        got = -1;
    } else if (hid->head != hid->tail && hid->queue[hid->tail % FAKE_HID_QUEUE].due <= knurl_system_now_ns()) {
        const uint32_t at = hid->tail++ % FAKE_HID_QUEUE;
        const size_t size = hid->queue[at].size < room ? hid->queue[at].size : room;
        memcpy(bytes, hid->queue[at].bytes, size);
        got = (int)size;
    }
    knurl_system_mutex_unlock(&hid->mutex);
    return got;
}

static int port_read(void *self, uint8_t *bytes, size_t room, int milliseconds) {
    const int64_t until = knurl_system_now_ns() + (int64_t)milliseconds * 1000000;
    int got = take(self, bytes, room);
    while (got == 0 && knurl_system_now_ns() < until) {
        knurl_system_sleep_until_ns(knurl_system_now_ns() + 100000);
        got = take(self, bytes, room);
    }
    return got;
}

static void port_close(void *self) {
    fake_hid *hid = self;
    knurl_system_mutex_lock(&hid->mutex);
    hid->closed++;
    knurl_system_mutex_unlock(&hid->mutex);
}

static size_t bus_look(void *user, uint16_t vendor, uint16_t product, knurl_rawhid_found *found, size_t capacity) {
    fake_hid *hid = user;
    size_t count = 0;
    knurl_system_mutex_lock(&hid->mutex);
    for (size_t i = 0; i < hid->found_count && count < capacity && hid->fault != DOUBLE_UNPLUG; i++) {
        const knurl_rawhid_found *one = &hid->found[i];
        if ((!vendor || one->vendor == vendor) && (!product || one->product == product)) {
            found[count++] = *one;
        }
    }
    knurl_system_mutex_unlock(&hid->mutex);
    return count;
}

static int bus_open(void *user, const knurl_rawhid_found *found, knurl_rawhid_port *port, char *why, size_t why_size) {
    const knurl_rawhid_port made = {user, port_write, port_read, port_close};
    fake_hid *hid = user;
    (void)found;
    if (hid->refuses_opening) {
        (void)snprintf(why, why_size, "device or resource busy");
        return 0;
    }
    knurl_system_mutex_lock(&hid->mutex);
    hid->opened++;
    hid->head = hid->tail = 0;
    knurl_system_mutex_unlock(&hid->mutex);
    *port = made;
    return 1;
}

void fake_hid_init(fake_hid *hid, size_t report_bytes, const knurl_stroke_desc *stroke) {
    const knurl_rawhid_bus bus = {hid, bus_look, bus_open, NULL};
    memset(hid, 0, sizeof *hid);
    knurl_system_mutex_init(&hid->mutex);
    hid_sim_init(&hid->sim, report_bytes, stroke);
    hid->random = 88172645463325252u;
    hid->bus = bus;
    const int is_teensy = report_bytes == 64;
    const knurl_rawhid_found found = {"/dev/hidraw0",
                                      "Simulated WoodenHaptics",
                                      is_teensy ? 0x16c0 : 0x1234,
                                      is_teensy ? 0x0486 : 0x0006,
                                      0xffab,
                                      0x0200,
                                      {(uint32_t)report_bytes, (uint32_t)report_bytes},
                                      0};
    hid->found[0] = found;
    hid->found_count = 1;
    hid->sim.time = hid->sim.heard_at = hid->sim.limp_from = seconds();
}

void fake_hid_destroy(fake_hid *hid) {
    knurl_system_mutex_destroy(&hid->mutex);
}

void fake_hid_inject(fake_hid *hid, int fault) {
    knurl_system_mutex_lock(&hid->mutex);
    if (fault == DOUBLE_JUMP) {
        hid->sim.shift[0] = 0.05;
        hid_sim_advance(&hid->sim, seconds());
    } else if (fault == DOUBLE_UNHOMED) {
        hid_sim_forget(&hid->sim);
    } else {
        hid->fault = fault;
    }
    knurl_system_mutex_unlock(&hid->mutex);
}

int64_t fake_hid_limp_since(fake_hid *hid) {
    knurl_system_mutex_lock(&hid->mutex);
    const double since = hid_sim_limp_since(&hid->sim, seconds());
    knurl_system_mutex_unlock(&hid->mutex);
    return since < 0.0 ? 0 : (int64_t)(since * 1e9);
}

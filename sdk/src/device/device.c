/* The device interface, above all drivers: opening, claims, start, status and close. SPDX-License-Identifier: MIT */
#include "device/link.h"
#include "device/port.h"

#include "base/atomic.h"
#include "base/base.h"
#include "base/rule.h"
#include "base/system.h"

#include <math.h>
#include <string.h>

/* ns that a close waits for another thread to send the zero: a few periods of the slowest loop. */
#define CLOSE_NS 50000000

/* s: the shortest gap that a position is checked against. If a device delivers positions at 1 kHz and is read faster,
 * its positions move in steps. */
#define LEAST_GAP 0.002

void knurl_device_status_init(knurl_device_status *status, uint32_t size) {
    const knurl_device_status defaults = {0};
    knurl_desc_write(&defaults, sizeof defaults, status, size);
}

void *knurl_device_allocate(const knurl_driver *driver, size_t size) {
    knurl_device *made = calloc(1, size);
    if (!made) {
        (void)knurl_fail(KNURL_ERROR_MEMORY, "device '%s': could not get %lu bytes", driver->uri, (unsigned long)size);
        return NULL;
    }
    knurl_device_init(made, driver);
    made->max_speed = KNURL_HAND_SPEED;
    return made;
}

static void close_now(knurl_device *device) {
    knurl_device_unregister(device);
    knurl_motor_heat_keep(device);
    device->driver->close(device);
}

/* Waits until the force of a device in use is zero. The loop's haptic thread or the I/O thread sends the zero; if the
 * caller is the haptic thread, or the loop is stepped and has no thread, it is sent here. */
static void await_zero(knurl_device *device, uint32_t use) {
    static const double none[3] = {0.0, 0.0, 0.0};
    const int is_here = !(use & KNURL_DEVICE_THREAD) || knurl_load_acquire(&device->thread) == knurl_system_thread_id();
    const int64_t until = knurl_system_now_ns() + CLOSE_NS;
    while (!__atomic_load_n(&device->quiet, __ATOMIC_SEQ_CST) && !knurl_load_acquire(&device->lost) &&
           knurl_system_now_ns() < until) {
        if (is_here && !device->link) {
            (void)knurl_device_write(device, none);
            return;
        }
        knurl_system_sleep_until_ns(knurl_system_now_ns() + 200000);
    }
}

/* The last of the owner and the loop that uses the device frees it. */
void knurl_device_close(knurl_device *device) {
    KNURL_RULE(END, device);
    if (!device || KNURL_BAD_HANDLE(device, DEVICE)) {
        return;
    }
    (void)__atomic_fetch_or(&device->halted, KNURL_HALTED | KNURL_HALTED_FOR_GOOD, __ATOMIC_SEQ_CST);
    const uint32_t use = knurl_load_acquire(&device->use);
    if (use & KNURL_DEVICE_LOOP) { /* must finish before the loop can see the close and free the device */
        await_zero(device, use);
    }
    if (__atomic_fetch_or(&device->use, KNURL_DEVICE_CLOSED, __ATOMIC_ACQ_REL) == 0) {
        close_now(device);
    }
}

void knurl_device_release(knurl_device *device) {
    if (__atomic_and_fetch(&device->use, KNURL_DEVICE_CLOSED, __ATOMIC_ACQ_REL)) {
        close_now(device);
    }
}

void knurl_device_claim_thread(knurl_device *device) {
    (void)__atomic_fetch_or(&device->use, KNURL_DEVICE_THREAD, __ATOMIC_ACQ_REL);
}

void knurl_device_enter_thread(knurl_device *device) {
    knurl_store_release(&device->thread, knurl_system_thread_id());
}

knurl_result knurl_device_check_unused(const knurl_device *device, uint32_t use) {
    if (knurl_load_acquire(&device->use) & use) {
        return knurl_fail(
            KNURL_ERROR_STATE,
            "device '%s' is in use by a loop; do this before the loop is created or after it is destroyed",
            device->driver->uri);
    }
    return KNURL_OK;
}

int knurl_device_is_closed(const knurl_device *device) {
    return (knurl_load_acquire(&device->halted) & KNURL_HALTED_FOR_GOOD) != 0;
}

int knurl_device_may_resume(const knurl_device *device) {
    return (knurl_load_acquire(&device->halted) & ~KNURL_HALTED) == 0;
}

knurl_result knurl_device_claim(knurl_device *device) {
    uint32_t use = 0;
    if (__atomic_compare_exchange_n(&device->use, &use, KNURL_DEVICE_LOOP, 0, __ATOMIC_ACQ_REL, __ATOMIC_RELAXED)) {
        return KNURL_OK;
    }
    if (use & KNURL_DEVICE_CLOSED) {
        return knurl_fail(KNURL_ERROR_STATE, "device '%s': expected an open one, found one that was closed",
                          device->driver->uri);
    }
    return knurl_fail(KNURL_ERROR_STATE,
                      "device '%s' is in use by another loop; destroy that loop first: a device belongs to one loop",
                      device->driver->uri);
}

knurl_result knurl_device_get_status(const knurl_device *device, knurl_device_status *status) {
    if (KNURL_BAD_HANDLE(device, DEVICE) || KNURL_IS_NULL(status)) {
        return KNURL_ERROR_ARGUMENT;
    }
    knurl_device_status made;
    knurl_device_status_init(&made, sizeof made);
    made.lost = knurl_load_acquire(&device->lost);
    made.halted = knurl_port_is_halted(device);
    made.buttons = knurl_load_relaxed(&device->buttons);
    double pose[5];
    knurl_seqlock_read(&device->orientation.sequence, device->orientation.words, pose, sizeof pose);
    memcpy(made.orientation, pose, sizeof made.orientation);
    made.grip = pose[4];
    made.battery = knurl_load_double(&device->battery);
    made.events = knurl_load_acquire(&device->events.head);
    if (device->link) {
        knurl_link_get_status(device->link, &made);
    }
    if (device->driver->get_status) {
        device->driver->get_status(device, &made);
    }
    return knurl_desc_return("knurl_device_status", &made, sizeof made, status);
}

uint32_t knurl_device_next_event(knurl_device *device, knurl_device_event *event) {
    KNURL_RULE(ONE, device);
    if (KNURL_BAD_HANDLE(device, DEVICE) || KNURL_IS_NULL(event)) {
        return 0;
    }
    return knurl_events_next(&device->events, event);
}

uint32_t knurl_port_is_io_realtime(const knurl_device *device) {
    return device->link && knurl_load_relaxed(&device->link->realtime);
}

/* Checks the properties and discards earlier positions. */
static knurl_result begin_check(knurl_device *device) {
    knurl_device_info info;
    const knurl_result result = knurl_device_ask(device, &info);
    if (!result) {
        memset(&device->check, 0, sizeof device->check);
        memset(device->torque, 0, sizeof device->torque);
        device->check.least_gap = info.native_rate > 0.0 ? fmax(LEAST_GAP, 2.0 / info.native_rate) : LEAST_GAP;
    }
    return result;
}

knurl_result knurl_device_start(knurl_device *device, double update_rate_hz) {
    KNURL_RULE(GAME, device);
    if (KNURL_BAD_HANDLE(device, DEVICE)) {
        return KNURL_ERROR_ARGUMENT;
    }
    const knurl_result result = knurl_device_check_unused(device, KNURL_DEVICE_LOOP);
    return result ? result : knurl_device_begin(device, update_rate_hz);
}

knurl_result knurl_device_begin(knurl_device *device, double update_rate_hz) {
    if (!knurl_is_within(update_rate_hz, 1.0, 100000.0)) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "update rate: expected 1 to 100000 Hz, found %g Hz", update_rate_hz);
    }
    if (device->link && update_rate_hz < 2.0 / KNURL_LINK_PATIENCE) {
        return knurl_fail(
            KNURL_ERROR_UNSUPPORTED,
            "update rate: the device plays a force for %g ms at most, expected %g Hz or more, found %g Hz",
            1e3 * KNURL_LINK_PATIENCE, 2.0 / KNURL_LINK_PATIENCE, update_rate_hz);
    }
    if (knurl_load_acquire(&device->lost) && knurl_device_reopen(device)) {
        return knurl_fail(KNURL_ERROR_DEVICE_LOST, "device '%s': it was lost, and cannot be found",
                          device->driver->uri);
    }
    knurl_result result = begin_check(device);
    result = result || !device->driver->start ? result : device->driver->start(device, update_rate_hz);
    if (!result) {
        if (device->link) {
            knurl_link_start(device->link, update_rate_hz);
        }
        device->period = 1.0 / update_rate_hz;
        if (device->motor_check.is_on) {
            knurl_motor_check_start(&device->motor_check, device->period);
        }
        knurl_port_release_halt(device);
    }
    return result;
}

knurl_result knurl_device_finish_open(knurl_device *device, knurl_result result, knurl_device **opened) {
    result = result ? result : knurl_device_start(device, 1000.0);
    if (result) {
        device->driver->close(device);
        return result;
    }
    *opened = device;
    return KNURL_OK;
}

knurl_result knurl_device_reopen(knurl_device *device) {
    if (!device->driver->reopen) {
        return KNURL_ERROR_DEVICE_LOST;
    }
    knurl_result result = device->driver->reopen(device);
    result = result ? result : begin_check(device);
    if (!result) {
        knurl_events_report(&device->events, KNURL_FAULT_RECONNECTED, 0.0);
        knurl_store_release(&device->lost, 0u);
    }
    return result;
}

/* 3D Systems Touch, through the HD library. Its scheduler owns the servo thread and serves all devices: it starts with
 * the first loop (preferably after all devices were opened) and stops when the last device is closed.
 * SPDX-License-Identifier: MIT */
#include "device/driver.h"
#include "device/touch/touch_device.h"

#include "base/atomic.h"
#include "base/system.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static unsigned long rate_now; /* Hz of the scheduler: HD's default when the first device is opened, then as last set */

#define HD_RATE 1000  /* HD's default */
static uint32_t busy; /* atomic: a lock, never taken by a servo thread */

/* hdInitDevice() takes a second or two. If it takes this long, it hangs, and keeps the lock. */
#define LOCK_NS INT64_C(10000000000)

static knurl_result lock(void) {
    const int64_t until = knurl_system_now_ns() + LOCK_NS;
    while (__atomic_exchange_n(&busy, 1u, __ATOMIC_ACQUIRE)) {
        if (knurl_system_now_ns() > until) {
            return knurl_fail(KNURL_ERROR_SYSTEM,
                              "device 'touch': HD's library hangs in an earlier call; unplug the device for a moment, "
                              "and start this program again");
        }
        knurl_system_sleep_until_ns(knurl_system_now_ns() + 200000);
    }
    return KNURL_OK;
}

static void unlock(void) {
    knurl_store_release(&busy, 0u);
}

static touch *of(knurl_device *device) {
    return (touch *)(void *)device; /* first member */
}

static void take_slot(touch *t) {
    t->slot = knurl_touch_find_slot(HD_NO_DEVICE);
    t->slot->owner = t;
    knurl_store_release(&t->slot->loss, 0u);
    knurl_store_release(&t->slot->refusal, 0u);
    __atomic_store_n(&t->slot->others, 0, __ATOMIC_RELAXED);
    knurl_store_release(&t->slot->key, t->handle + 1u);
}

static knurl_result open_locked(const char *name, const char *library, knurl_device **device) {
    int is_first = 1;
    for (int i = 0; i < TOUCH_ROOM; i++) {
        is_first &= !knurl_touch_slots[i].owner;
    }
    const hd_api *hd = NULL;
    if (!knurl_touch_find_slot(HD_NO_DEVICE)) {
        return knurl_fail(KNURL_ERROR_SYSTEM, "device 'touch': expected at most %d open devices", TOUCH_ROOM);
    }
    char uri[KNURL_URI_ROOM + 8];
    (void)snprintf(uri, sizeof uri, "touch%s%s", name[0] ? ":" : "", name);
    knurl_result result = knurl_hd_acquire(library, uri, &hd);
    if (result) {
        return result;
    }
    touch *made = knurl_device_allocate(&knurl_touch_driver, sizeof *made);
    if (!made) {
        knurl_hd_release();
        return KNURL_ERROR_MEMORY;
    }
    made->hd = hd;
    memcpy(made->uri, uri, sizeof uri);
    (void)snprintf(made->name, sizeof made->name, "%s", name);
    result = knurl_touch_connect(made);
    if (result) {
        knurl_hd_release();
        knurl_device_free(&made->base);
        return result;
    }
    rate_now = is_first ? HD_RATE : rate_now;
    take_slot(made);
    made->base.max_force = made->info.max_force;
    made->base.quiet = 1;
    *device = &made->base;
    return KNURL_OK;
}

static knurl_result touch_open(const char *options, knurl_device **device) {
    char name[KNURL_URI_ROOM];
    char library[KNURL_URI_ROOM];
    char guard[KNURL_URI_ROOM];
    uint32_t wants_guard = 0;
    const knurl_uri_key keys[] = {{"library", library}, {"guard", guard}};
    knurl_result result = knurl_uri_parse("touch", options, name, keys, 2);
    result = result ? result : knurl_uri_flag("touch", "guard", guard, &wants_guard);
    if (wants_guard) {
        result = knurl_fail(
            KNURL_ERROR_UNSUPPORTED,
            "device 'touch': guard: not possible: 3D Systems' library drives it from within this process, by an "
            "unpublished protocol");
    }
    result = result ? result : lock();
    if (!result) {
        result = open_locked(name, library, device);
        unlock();
    }
    return result;
}

static void touch_close(knurl_device *device) {
    touch *t = of(device);
    if (lock()) {
        knurl_handle_clear(&device->handle); /* leaked, as below */
        return;
    }
    if (knurl_touch_detach(t)) {
        knurl_touch_unschedule(t);
        knurl_touch_disconnect(t);
        t->slot->owner = NULL;
        knurl_device_free(device);
        knurl_hd_release();
    } else { /* HD hangs in a call for this device and may still use its memory, which is leaked */
        knurl_handle_clear(&device->handle);
    }
    unlock();
}

static void touch_info(const knurl_device *device, knurl_device_info *info) {
    *info = ((const touch *)(const void *)device)->info;
}

static void touch_status(const knurl_device *device, knurl_device_status *status) {
    const touch_slot *slot = ((const touch *)(const void *)device)->slot;
    status->bad_bytes = __atomic_load_n(&slot->others, __ATOMIC_RELAXED); /* HD reports errors, not bytes */
}

static knurl_result start_locked(touch *t, double rate) {
    const unsigned long whole = (unsigned long)rate;
    if ((double)whole != rate) {
        return knurl_fail(KNURL_ERROR_UNSUPPORTED,
                          "device '%s': expected a whole number of Hz, found %g Hz; HD's scheduler supports no other",
                          t->uri, rate);
    }
    for (int i = 0; i < TOUCH_ROOM; i++) {
        if (&knurl_touch_slots[i] != t->slot && knurl_load_acquire(&knurl_touch_slots[i].device) && whole != rate_now) {
            return knurl_fail(KNURL_ERROR_UNSUPPORTED,
                              "device '%s': expected %lu Hz, found %lu Hz; HD has one scheduler for all "
                              "devices, and another runs at that rate",
                              t->uri, rate_now, whole);
        }
    }
    (void)knurl_touch_take_errors(t->hd, t->slot);
    t->hd->set_rate(whole);
    const uint32_t code = knurl_touch_take_errors(t->hd, t->slot);
    if (code == 0x0102 && whole == rate_now) {
        return KNURL_OK; /* OpenHaptics 3.0 cannot change its rate, which is already right */
    }
    if (code == 0x0102) {
        return knurl_fail(
            KNURL_ERROR_UNSUPPORTED,
            "device '%s': expected %lu Hz, found %lu Hz; this version of HD's scheduler cannot change its rate", t->uri,
            rate_now, whole);
    }
    if (code) {
        return knurl_fail(KNURL_ERROR_UNSUPPORTED,
                          "device '%s': HD's scheduler refuses %lu Hz (0x%04x: %s); 500, 1000 and mostly 2000 Hz "
                          "are known to work",
                          t->uri, whole, (unsigned)code, knurl_hd_error_sentence(code));
    }
    rate_now = whole;
    return KNURL_OK;
}

static knurl_result touch_start(knurl_device *device, double update_rate_hz) {
    knurl_result result = lock();
    if (!result) {
        result = start_locked(of(device), update_rate_hz);
        unlock();
    }
    return result;
}

static knurl_result touch_serve(knurl_device *device, uint32_t (*tick)(void *argument), void *argument) {
    touch *t = of(device);
    knurl_result result = lock();
    if (result) {
        return result;
    }
    if (!knurl_touch_detach(t)) { /* the last loop's last call */
        result = knurl_fail(KNURL_ERROR_STATE, "device '%s': HD's scheduler is still busy with the last loop", t->uri);
    } else {
        knurl_touch_unschedule(t);
        t->tick = tick;
        t->argument = argument;
        result = knurl_touch_schedule(t);
    }
    unlock();
    return result;
}

static knurl_result touch_reopen(knurl_device *device) {
    touch *t = of(device);
    if (lock()) {
        return KNURL_ERROR_DEVICE_LOST;
    }
    knurl_result result = KNURL_ERROR_DEVICE_LOST;
    if (knurl_touch_detach(t)) {
        knurl_touch_unschedule(t);
        knurl_touch_disconnect(t);
        result = knurl_touch_connect(t);
        if (!result) {
            t->uncalibrated = 0; /* the servo thread is detached */
            knurl_store_release(&t->slot->key, t->handle + 1u);
            knurl_store_release(&t->slot->refusal, 0u);
            knurl_store_release(&t->slot->loss, 0u);
            result = t->tick ? knurl_touch_schedule(t) : KNURL_OK;
        }
    }
    unlock();
    return result;
}

static uint32_t touch_leave(knurl_device *device) {
    touch *t = of(device); /* no call of HD here, because HD may hang */
    return !knurl_load_acquire(&knurl_touch_is_paused) && !__atomic_load_n(&t->slot->inside, __ATOMIC_SEQ_CST) &&
           knurl_touch_detach(t);
}

/* Looks for the default device. Only called if this process has no device open. */
static void list_default(knurl_listings *listings) {
    touch t;
    memset(&t, 0, sizeof t);
    (void)snprintf(t.uri, sizeof t.uri, "touch");
    if (knurl_hd_acquire("", t.uri, &t.hd)) {
        knurl_listings_add(listings, "touch", "3D Systems Touch", "%s", knurl_error_message());
        return;
    }
    if (knurl_touch_connect(&t)) {
        knurl_listings_add(listings, "touch", "3D Systems Touch", "%s", knurl_error_message());
    } else {
        knurl_touch_disconnect(&t);
        knurl_listings_add(listings, "touch", t.title, "%s", "");
    }
    knurl_hd_release();
}

static void touch_list(knurl_listings *listings) {
    uint32_t open = 0;
    if (lock()) {
        knurl_listings_add(listings, "touch", "3D Systems Touch", "%s", knurl_error_message());
        return;
    }
    for (int i = 0; i < TOUCH_ROOM; i++) {
        const touch *t = knurl_touch_slots[i].owner;
        if (t) {
            knurl_listings_add(listings, t->uri, t->title, "in use: this program has it open already");
            open++;
        }
    }
    if (!open) {
        list_default(listings);
    }
    unlock();
}

const knurl_driver knurl_touch_driver = {
    .uri = "touch",
    .keeps_heat = 1,
    .list = touch_list,
    .open = touch_open,
    .close = touch_close,
    .get_info = touch_info,
    .get_status = touch_status,
    .start = touch_start,
    .read = knurl_touch_read,
    .write = knurl_touch_write,
    .reopen = touch_reopen,
    .serve = touch_serve,
    .leave = touch_leave,
};

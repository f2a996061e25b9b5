/* 3D Systems Touch, by the HD library. Its scheduler owns the servo thread and is one for all devices: it starts with
 * the first loop (better after all devices were opened) and stops when the last device is closed.
 * SPDX-License-Identifier: MIT */
#include "device/touch/touch.h"

#include "base/atomic.h"
#include "base/system.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* How long a call of the scheduler's may go on after its tick has ended, ns. */
#define PATIENCE_NS 200000000

static const char udev_help[] =
#if defined(_WIN32)
    "";
#else
    "; if only the permission is missing: copy sdk/udev/70-knurl.rules to /etc/udev/rules.d, run 'udevadm control "
    "--reload' and 'udevadm trigger', and plug it in again";
#endif

static uint32_t busy; /* atomic: held by who opens, closes, starts or looks again; never by a servo thread */
static struct {
    uint32_t users;
    unsigned long rate; /* Hz, as set by the latest start; 0: never */
} scheduler;

static void lock(void) {
    while (__atomic_exchange_n(&busy, 1u, __ATOMIC_ACQUIRE)) {
        knurl_system_sleep_until_ns(knurl_system_now_ns() + 200000);
    }
}

static void unlock(void) {
    knurl_store_release(&busy, 0u);
}

static touch *of(knurl_device *device) {
    return (touch *)(void *)device; /* its first member */
}

static const char *name_of(const touch *t) {
    return t->name[0] ? t->name : "the default device";
}

/* From now on the scheduler's calls find nothing. 0: one goes on. */
static int detach(touch *t) {
    const int64_t until = knurl_system_now_ns() + PATIENCE_NS;
    __atomic_store_n(&t->slot->device, NULL, __ATOMIC_SEQ_CST);
    while (__atomic_load_n(&t->slot->inside, __ATOMIC_SEQ_CST)) {
        if (knurl_system_now_ns() > until) {
            return 0;
        }
        knurl_system_sleep_until_ns(knurl_system_now_ns() + 100000);
    }
    return 1;
}

static void unschedule(touch *t) {
    if (knurl_load_acquire(&t->slot->scheduled)) {
        t->hd->unschedule(t->task);
        knurl_store_release(&t->slot->scheduled, 0u);
    }
}

static void leave_scheduler(touch *t) {
    if (t->uses_scheduler && --scheduler.users == 0) {
        t->hd->stop_scheduler();
    }
    t->uses_scheduler = 0;
}

/* The tick shall be called from now on. */
static knurl_result schedule(touch *t) {
    t->until_check = 0;
    t->pause = 0;
    t->told_loss = 0;
    __atomic_store_n(&t->slot->device, t, __ATOMIC_SEQ_CST);
    if (!t->uses_scheduler) {
        t->uses_scheduler = 1;
        if (scheduler.users++ == 0) {
            t->hd->start_scheduler();
        }
    }
    knurl_store_release(&t->slot->scheduled, 1u);
    t->task = t->hd->schedule(touch_servo, t->slot, HD_PRIORITY_MOST);
    const uint32_t code = touch_take_errors(t->hd, t->slot);
    if (code >= 0x0500 || code == 0x0304) {
        (void)detach(t);
        unschedule(t);
        leave_scheduler(t);
        return knurl_fail(KNURL_ERROR_SYSTEM, "device 'touch' (%s): HD's scheduler does not start: 0x%04x: %s",
                          name_of(t), (unsigned)code, hd_error_sentence(code));
    }
    return KNURL_OK;
}

/* The slot whose device has this handle, or (HD_NO_DEVICE) a free one; null: there is none. */
static touch_slot *find_slot(hd_device handle) {
    for (int i = 0; i < TOUCH_ROOM; i++) {
        touch_slot *slot = &touch_slots[i];
        if (handle == HD_NO_DEVICE ? !slot->owner : slot->owner && slot->owner->handle == handle) {
            return slot;
        }
    }
    return NULL;
}

/* By its name; the default one by the names that HD's versions know it by. HD_NO_DEVICE: *code says why. */
static hd_device initialise(const hd_api *hd, const char *name, uint32_t *code) {
    static const char *const defaults[] = {NULL, "Default Device", "Default PHANToM"};
    const size_t count = name[0] ? 1 : sizeof defaults / sizeof *defaults;
    hd_device handle = HD_NO_DEVICE;
    *code = 0;
    for (size_t i = 0; i < count && handle == HD_NO_DEVICE; i++) {
        (void)touch_take_errors(hd, NULL);
        handle = hd->init(name[0] ? name : defaults[i]);
        const uint32_t told = touch_take_errors(hd, NULL);
        *code = *code ? *code : told; /* the first name's */
        if (handle != HD_NO_DEVICE && find_slot(handle)) {
            *code = 0x0301;
            return HD_NO_DEVICE; /* another of ours: nothing to give back */
        }
        if (handle != HD_NO_DEVICE && told) {
            hd->disable_device(handle);
            *code = told;
            handle = HD_NO_DEVICE;
        }
    }
    return handle;
}

/* Calls that are about the current device: in a turn of the scheduler's where it runs for others, whose frames would
 * else make theirs the current one in between. */
static void in_turn(touch *t, hd_callback calls) {
    if (scheduler.users > 0) {
        t->hd->call_in_turn(calls, t, HD_PRIORITY_MOST);
    } else {
        (void)calls(t);
    }
}

static uint32_t HD_CALL prepare(void *user) {
    touch *t = user;
    t->hd->make_current(t->handle);
    (void)touch_take_errors(t->hd, NULL);
    t->hd->enable(HD_FORCE_OUTPUT);
    t->trouble = touch_take_errors(t->hd, NULL);
    if (!t->title[0]) { /* once: others may be reading it later */
        touch_ask_info(t);
    }
    t->style = t->hd->calibration_style();
    (void)touch_take_errors(t->hd, NULL); /* of what this version of HD does not tell */
    return HD_DONE;
}

static uint32_t HD_CALL switch_off(void *user) {
    touch *t = user;
    t->hd->make_current(t->handle);
    t->hd->disable(HD_FORCE_OUTPUT);
    (void)touch_take_errors(t->hd, NULL); /* it may be away */
    return HD_DONE;
}

/* Finds the device and has it ready to play forces. Errors as knurl_device_open(). */
static knurl_result connect(touch *t) {
    uint32_t code = 0;
    t->handle = initialise(t->hd, t->name, &code);
    if (t->handle != HD_NO_DEVICE) {
        in_turn(t, prepare);
        code = t->trouble;
        if (!code) {
            return KNURL_OK;
        }
        t->hd->disable_device(t->handle);
        t->handle = HD_NO_DEVICE;
    }
    const int unreachable = code == 0 || (code >= 0x0300 && code != 0x0301 && code < 0x0400);
    return knurl_fail(unreachable ? KNURL_ERROR_DEVICE_LOST : KNURL_ERROR_SYSTEM,
                      "device 'touch': %s cannot be opened: 0x%04x: %s%s", name_of(t), (unsigned)code,
                      hd_error_sentence(code), unreachable ? udev_help : "");
}

/* Gives HD its device back. */
static void disconnect(touch *t) {
    leave_scheduler(t);
    if (t->handle != HD_NO_DEVICE) {
        in_turn(t, switch_off);
        t->hd->disable_device(t->handle);
        (void)touch_take_errors(t->hd, NULL);
        t->handle = HD_NO_DEVICE;
    }
    if (t->slot) {
        knurl_store_release(&t->slot->key, 0u);
    }
}

static void take_slot(touch *t) {
    t->slot = find_slot(HD_NO_DEVICE);
    t->slot->owner = t;
    knurl_store_release(&t->slot->loss, 0u);
    knurl_store_release(&t->slot->refusal, 0u);
    __atomic_store_n(&t->slot->others, 0, __ATOMIC_RELAXED);
    knurl_store_release(&t->slot->key, t->handle + 1u);
}

static knurl_result open_locked(const char *name, const char *library, knurl_device **device) {
    const hd_api *hd = NULL;
    if (!find_slot(HD_NO_DEVICE)) {
        return knurl_fail(KNURL_ERROR_SYSTEM, "device 'touch': expected at most %d open ones", TOUCH_ROOM);
    }
    knurl_result result = hd_acquire(library, &hd);
    if (result) {
        return result;
    }
    touch *made = calloc(1, sizeof *made);
    if (!made) {
        hd_release();
        return knurl_fail(KNURL_ERROR_MEMORY, "device 'touch': could not get %u bytes", (unsigned)sizeof *made);
    }
    made->hd = hd;
    (void)snprintf(made->name, sizeof made->name, "%s", name);
    result = connect(made);
    if (result) {
        hd_release();
        free(made);
        return result;
    }
    take_slot(made);
    made->base.driver = &knurl_touch_driver;
    made->base.max_force = made->info.max_force;
    made->base.max_speed = KNURL_HAND_SPEED;
    made->base.quiet = 1;
    *device = &made->base;
    return KNURL_OK;
}

static knurl_result touch_open(const char *options, knurl_device **device) {
    char name[KNURL_URI_ROOM];
    char library[KNURL_URI_ROOM];
    const knurl_uri_key keys[] = {{"library", library}};
    knurl_result result = knurl_uri_parse("touch", options, name, keys, 1);
    if (!result) {
        lock();
        result = open_locked(name, library, device);
        unlock();
    }
    return result;
}

static void touch_close(knurl_device *device) {
    touch *t = of(device);
    lock();
    if (detach(t)) {
        unschedule(t);
        disconnect(t);
        t->slot->owner = NULL;
        free(t);
        hd_release();
    } /* else HD hangs inside of a call for this device: what that may still use is left to it */
    unlock();
}

static void touch_info(const knurl_device *device, knurl_device_info *info) {
    *info = ((const touch *)(const void *)device)->info;
}

static void touch_status(const knurl_device *device, knurl_device_status *status) {
    const touch_slot *slot = ((const touch *)(const void *)device)->slot;
    status->bad_bytes = __atomic_load_n(&slot->others, __ATOMIC_RELAXED); /* HD hands out errors, not bytes */
}

static knurl_result start_locked(touch *t, double rate) {
    const unsigned long whole = (unsigned long)rate;
    if ((double)whole != rate) {
        return knurl_fail(
            KNURL_ERROR_UNSUPPORTED,
            "device 'touch' (%s): expected a whole number of Hz, found %g Hz; HD's scheduler keeps no other",
            name_of(t), rate);
    }
    for (int i = 0; i < TOUCH_ROOM; i++) {
        if (&touch_slots[i] != t->slot && knurl_load_acquire(&touch_slots[i].device) && whole != scheduler.rate) {
            return knurl_fail(KNURL_ERROR_UNSUPPORTED,
                              "device 'touch' (%s): expected %lu Hz, found %lu Hz; HD has one scheduler for all "
                              "devices, and another runs at that rate",
                              name_of(t), scheduler.rate, whole);
        }
    }
    (void)touch_take_errors(t->hd, t->slot);
    t->hd->set_rate(whole);
    const uint32_t code = touch_take_errors(t->hd, t->slot);
    if (code) {
        return knurl_fail(
            KNURL_ERROR_UNSUPPORTED,
            "device 'touch' (%s): HD's scheduler refuses %lu Hz (0x%04x: %s); 500, 1000 and mostly 2000 Hz "
            "are known to work",
            name_of(t), whole, (unsigned)code, hd_error_sentence(code));
    }
    scheduler.rate = whole;
    return KNURL_OK;
}

static knurl_result touch_start(knurl_device *device, double update_rate_hz) {
    lock();
    const knurl_result result = start_locked(of(device), update_rate_hz);
    unlock();
    return result;
}

static knurl_result touch_serve(knurl_device *device, uint32_t (*tick)(void *argument), void *argument) {
    touch *t = of(device);
    lock();
    knurl_result result = KNURL_OK;
    if (!detach(t)) { /* the latest loop's last call */
        result = knurl_fail(KNURL_ERROR_STATE, "device 'touch' (%s): HD's scheduler is still busy with the latest loop",
                            name_of(t));
    } else {
        unschedule(t);
        t->tick = tick;
        t->argument = argument;
        result = schedule(t);
    }
    unlock();
    return result;
}

static knurl_result touch_reopen(knurl_device *device) {
    touch *t = of(device);
    lock();
    knurl_result result = KNURL_ERROR_DEVICE_LOST;
    if (detach(t)) {
        unschedule(t);
        disconnect(t);
        result = connect(t);
        if (!result) {
            knurl_store_release(&t->slot->key, t->handle + 1u);
            knurl_store_release(&t->slot->refusal, 0u);
            knurl_store_release(&t->slot->loss, 0u);
            result = t->tick ? schedule(t) : KNURL_OK;
        }
    }
    unlock();
    return result;
}

static uint32_t touch_leave(knurl_device *device) {
    return (uint32_t)detach(of(device)); /* HD may hang: it is asked for nothing here */
}

/* One look at the default device, where nobody in this process has one. */
static void list_default(knurl_listings *listings) {
    touch t;
    memset(&t, 0, sizeof t);
    if (hd_acquire("", &t.hd)) {
        knurl_listings_add(listings, "touch", "3D Systems Touch", "%s", knurl_error_message());
        return;
    }
    if (connect(&t)) {
        knurl_listings_add(listings, "touch", "3D Systems Touch", "%s", knurl_error_message());
    } else {
        disconnect(&t);
        knurl_listings_add(listings, "touch", t.title, "%s", "");
    }
    hd_release();
}

static void touch_list(knurl_listings *listings) {
    uint32_t open = 0;
    lock();
    for (int i = 0; i < TOUCH_ROOM; i++) {
        const touch *t = touch_slots[i].owner;
        if (t) {
            char uri[KNURL_URI_ROOM + 8];
            (void)snprintf(uri, sizeof uri, "touch%s%s", t->name[0] ? ":" : "", t->name);
            knurl_listings_add(listings, uri, t->title, "in use: this program has it open already");
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
    .list = touch_list,
    .open = touch_open,
    .close = touch_close,
    .get_info = touch_info,
    .get_status = touch_status,
    .start = touch_start,
    .read = touch_read,
    .write = touch_write,
    .reopen = touch_reopen,
    .serve = touch_serve,
    .leave = touch_leave,
};

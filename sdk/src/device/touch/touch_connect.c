/* Connects a Touch through HD, and starts and stops HD's scheduler. All calls need the lock of touch.c.
 * SPDX-License-Identifier: MIT */
#include "device/touch/touch_device.h"

#include "base/atomic.h"
#include "base/system.h"
#include "device/driver.h"

#include <string.h>

/* ns that a detach waits for a scheduler call to end. */
#define PATIENCE_NS 200000000

static const char udev_help[] =
#ifdef __linux__
    "; if only the permission is missing: " KNURL_PERMISSION_ADVICE;
#else
    "";
#endif

/* ns to wait for the forces of other devices to become zero before the scheduler is paused. */
#define PAUSE_NS 20000000

static uint32_t users; /* devices that use the scheduler */
uint32_t knurl_touch_is_paused;

int knurl_touch_detach(touch *t) {
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

void knurl_touch_unschedule(touch *t) {
    if (knurl_load_acquire(&t->slot->scheduled)) {
        t->hd->unschedule(t->task);
        knurl_store_release(&t->slot->scheduled, 0u);
    }
}

static void leave_scheduler(touch *t) {
    if (t->uses_scheduler && --users == 0) {
        t->hd->stop_scheduler();
    }
    t->uses_scheduler = 0;
}

knurl_result knurl_touch_schedule(touch *t) {
    t->until_check = 0;
    t->pause = 0;
    t->told_loss = 0;
    __atomic_store_n(&t->slot->device, t, __ATOMIC_SEQ_CST);
    if (!t->uses_scheduler) {
        t->uses_scheduler = 1;
        if (users++ == 0) {
            t->hd->start_scheduler();
        }
    }
    knurl_store_release(&t->slot->scheduled, 1u);
    t->task = t->hd->schedule(knurl_touch_servo, t->slot, HD_PRIORITY_MOST);
    const uint32_t code = knurl_touch_take_errors(t->hd, t->slot);
    if (code >= 0x0500 || code == 0x0304) {
        (void)knurl_touch_detach(t);
        knurl_touch_unschedule(t);
        leave_scheduler(t);
        return knurl_fail(KNURL_ERROR_SYSTEM, "device '%s': HD's scheduler does not start: 0x%04x: %s", t->uri,
                          (unsigned)code, knurl_hd_error_sentence(code));
    }
    return KNURL_OK;
}

touch_slot *knurl_touch_find_slot(hd_device handle) {
    for (int i = 0; i < TOUCH_ROOM; i++) {
        touch_slot *slot = &knurl_touch_slots[i];
        if (handle == HD_NO_DEVICE ? !slot->owner : slot->owner && slot->owner->handle == handle) {
            return slot;
        }
    }
    return NULL;
}

/* By its name; the default device by its names in versions of HD. On failure HD_NO_DEVICE, with the error in *code. */
static hd_device initialise(const hd_api *hd, const char *name, uint32_t *code) {
    static const char *const defaults[] = {NULL, "Default Device", "Default PHANToM"};
    const size_t count = name[0] ? 1 : sizeof defaults / sizeof *defaults;
    hd_device handle = HD_NO_DEVICE;
    *code = 0;
    for (size_t i = 0; i < count && handle == HD_NO_DEVICE; i++) {
        (void)knurl_touch_take_errors(hd, NULL);
        handle = hd->init(name[0] ? name : defaults[i]);
        const uint32_t error = knurl_touch_take_errors(hd, NULL);
        *code = *code ? *code : error; /* of the first name */
        handle = handle <= HD_DEVICE_MOST ? handle : HD_NO_DEVICE;
        if (handle != HD_NO_DEVICE && knurl_touch_find_slot(handle)) {
            *code = 0x0301;
            return HD_NO_DEVICE; /* another of this process: do not disable it */
        }
        if (handle != HD_NO_DEVICE && error) {
            hd->disable_device(handle);
            *code = error;
            handle = HD_NO_DEVICE;
        }
    }
    return handle;
}

/* Calls functions for the current device. If the scheduler runs for other devices, they are called in a turn of it, so
 * that no frame makes another device current in between. */
static void in_turn(touch *t, hd_callback calls) {
    if (users > 0) {
        t->hd->call_in_turn(calls, t, HD_PRIORITY_MOST);
    } else {
        (void)calls(t);
    }
}

/* Chooses one of the device's styles, in the order of the maker's examples. 0 if this version of HD lists no style. */
static hd_enum choose_style(const hd_api *hd) {
    static const hd_enum best_first[] = {HD_STYLE_AUTO, HD_STYLE_INKWELL, HD_STYLE_ENCODER};
    int32_t offered = 0;
    hd->get_integers(HD_CALIBRATION_STYLE, &offered);
    for (size_t i = 0; i < sizeof best_first / sizeof *best_first; i++) {
        if ((hd_enum)offered & best_first[i]) {
            return best_first[i];
        }
    }
    return 0;
}

static uint32_t HD_CALL prepare(void *user) {
    touch *t = user;
    t->hd->make_current(t->handle);
    (void)knurl_touch_take_errors(t->hd, NULL);
    t->hd->enable(HD_FORCE_OUTPUT);
    t->trouble = knurl_touch_take_errors(t->hd, NULL);
    if (!t->title[0]) { /* once: other threads may read it later */
        knurl_touch_ask_info(t);
    }
    t->style = choose_style(t->hd);
    (void)knurl_touch_take_errors(t->hd, NULL); /* from queries that this version of HD does not support */
    return HD_DONE;
}

static uint32_t HD_CALL switch_off(void *user) {
    touch *t = user;
    t->hd->make_current(t->handle);
    t->hd->disable(HD_FORCE_OUTPUT);
    (void)knurl_touch_take_errors(t->hd, NULL); /* the device may be gone */
    return HD_DONE;
}

/* OpenHaptics' documents do not define whether hdInitDevice() may be called while the scheduler runs; SOFA stops it
 * first, and so does this. Before that the forces of the other devices go to zero; their loops ramp them up again. */
static int pause_scheduler(touch *t) {
    const int64_t until = knurl_system_now_ns() + PAUSE_NS;
    if (users == 0) {
        return 0;
    }
    for (int i = 0; i < TOUCH_ROOM; i++) {
        touch *other = knurl_touch_slots[i].owner;
        if (other && other != t) {
            knurl_device_halt(&other->base);
            while (!knurl_load_acquire(&other->base.quiet) && knurl_system_now_ns() < until) {
                knurl_system_sleep_until_ns(knurl_system_now_ns() + 200000);
            }
        }
    }
    knurl_store_release(&knurl_touch_is_paused, 1u);
    t->hd->stop_scheduler();
    return 1;
}

static void resume_scheduler(const touch *t) {
    t->hd->start_scheduler();
    knurl_store_release(&knurl_touch_is_paused, 0u);
}

knurl_result knurl_touch_connect(touch *t) {
    uint32_t code = 0;
    const int was_running = pause_scheduler(t);
    t->handle = initialise(t->hd, t->name, &code);
    if (t->handle != HD_NO_DEVICE) {
        (void)prepare(t);
        code = t->trouble;
        if (code) {
            t->hd->disable_device(t->handle);
            t->handle = HD_NO_DEVICE;
        }
    }
    if (was_running) {
        resume_scheduler(t);
    }
    if (t->handle != HD_NO_DEVICE) {
        return KNURL_OK;
    }
    const int unreachable = code == 0 || (code >= 0x0300 && code != 0x0301 && code < 0x0400);
    return knurl_fail(unreachable ? KNURL_ERROR_DEVICE_LOST : KNURL_ERROR_SYSTEM,
                      "device '%s' cannot be opened: 0x%04x: %s%s", t->uri, (unsigned)code,
                      knurl_hd_error_sentence(code), unreachable ? udev_help : "");
}

void knurl_touch_disconnect(touch *t) {
    leave_scheduler(t);
    if (t->handle != HD_NO_DEVICE) {
        in_turn(t, switch_off);
        t->hd->disable_device(t->handle);
        (void)knurl_touch_take_errors(t->hd, NULL);
        t->handle = HD_NO_DEVICE;
    }
    if (t->slot) {
        knurl_store_release(&t->slot->key, 0u);
    }
}

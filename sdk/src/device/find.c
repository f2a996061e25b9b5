/* Finds the driver of a URI, and lists connected devices. SPDX-License-Identifier: MIT */
#include "device/driver.h"

#include "base/atomic.h"
#include "base/rule.h"
#include "base/system.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define LISTING_ROOM 64 /* per driver */
#define LOOK_NS      INT64_C(2000000000)
#define STACK_BYTES  ((size_t)256 * 1024)

static const knurl_driver *const drivers[] = {&knurl_fake_driver,    &knurl_touch_driver,  &knurl_falcon_driver,
                                              &knurl_rawhid_driver,  &knurl_serial_driver, &knurl_dhd_driver,
                                              &knurl_inverse3_driver};

#define DRIVER_COUNT (sizeof drivers / sizeof *drivers)

knurl_result knurl_device_open(const char *uri, knurl_device **device) {
    KNURL_RULE(GAME, NULL);
    if (KNURL_IS_NULL(uri) || KNURL_IS_NULL(device)) {
        return KNURL_ERROR_ARGUMENT;
    }
    char known[128] = "";
    const size_t length = strcspn(uri, ":");
    for (size_t i = 0; i < DRIVER_COUNT; i++) {
        const knurl_driver *driver = drivers[i];
        if (strlen(driver->uri) == length && strncmp(driver->uri, uri, length) == 0) {
            const knurl_result result = driver->open(uri[length] == ':' ? uri + length + 1 : "", device);
            if (!result) {
                knurl_device_register(*device);
            }
            return result;
        }
        const size_t used = strlen(known);
        const char *before = i == 0 ? "" : i + 1 < DRIVER_COUNT ? ", " : " or ";
        (void)snprintf(known + used, sizeof known - used, "%s%s", before, driver->uri);
    }
    return knurl_fail(KNURL_ERROR_UNKNOWN, "device: expected %s, found '%s'", known, uri);
}

/* One driver's listing, on its own thread because a vendor's library may hang. */
typedef struct look {
    const knurl_driver *driver;
    knurl_thread *thread;
    knurl_listings found;
    knurl_device_listing room[LISTING_ROOM];
    /* atomics */
    uint32_t may_begin; /* 1: all threads have been created */
    uint32_t is_done;
} look;

/* Loads no library before all threads have been created: glibc before 2.34 may abort if a thread is created while
 * another one loads a library (its bug 19329). */
static void run_look(void *argument) {
    look *l = argument;
    while (!knurl_load_acquire(&l->may_begin)) {
        knurl_system_sleep_until_ns(knurl_system_now_ns() + 50000);
    }
    l->driver->list(&l->found);
    knurl_store_release(&l->is_done, 1u);
}

static look *start_look(const knurl_driver *driver) {
    look *l = calloc(1, sizeof *l);
    if (l) {
        l->driver = driver;
        l->found.to = l->room;
        l->found.capacity = LISTING_ROOM;
        l->thread = knurl_system_start_thread(run_look, l, STACK_BYTES);
    }
    if (l && !l->thread) {
        free(l);
        l = NULL;
    }
    return l;
}

/* Adds the devices found before `deadline`. If the driver hangs, its thread and memory are leaked. */
static void finish_look(look *l, int64_t deadline, knurl_listings *listings) {
    while (!knurl_load_acquire(&l->is_done) && knurl_system_now_ns() < deadline) {
        knurl_system_sleep_until_ns(knurl_system_now_ns() + 500000);
    }
    if (!knurl_load_acquire(&l->is_done)) {
        knurl_listings_add(listings, l->driver->uri, l->driver->uri,
                           "its driver or its maker's library does not answer within %g s; end other programs that use "
                           "the device, or unplug it for a moment",
                           1e-9 * (double)LOOK_NS);
        return;
    }
    for (uint32_t i = 0; i < l->found.count && i < LISTING_ROOM; i++) {
        knurl_listings_add(listings, l->room[i].uri, l->room[i].name, "%s", l->room[i].reason);
    }
    knurl_system_join_thread(l->thread);
    free(l);
}

uint32_t knurl_device_list(knurl_device_listing *listings, uint32_t capacity) {
    KNURL_RULE(GAME, NULL);
    knurl_listings found = {listings, listings ? capacity : 0, 0};
    look *looks[DRIVER_COUNT];
    const int64_t deadline = knurl_system_now_ns() + LOOK_NS;
    for (size_t i = 0; i < DRIVER_COUNT; i++) {
        looks[i] = start_look(drivers[i]);
    }
    for (size_t i = 0; i < DRIVER_COUNT; i++) {
        if (looks[i]) {
            knurl_store_release(&looks[i]->may_begin, 1u);
        }
    }
    for (size_t i = 0; i < DRIVER_COUNT; i++) {
        if (looks[i]) {
            finish_look(looks[i], deadline, &found);
        } else {
            drivers[i]->list(&found);
        }
    }
    return found.count;
}

/* Keeps the motor heat of closed devices. SPDX-License-Identifier: MIT */
#include "device/driver.h"
#include "device/port.h"

#include "base/atomic.h"

/* More slots than drivers that keep heat. */
#define KINDS 16

static struct {
    const knurl_driver *driver; /* null if free */
    knurl_motor_heat motors;
} kept[KINDS];

static uint32_t held; /* atomic: spin lock for a few loads and stores when a device is closed or a loop starts */

/* Called with `held`. Null if the driver keeps no heat, or if there is no room. */
static knurl_motor_heat *find(const knurl_device *device) {
    for (int i = 0; i < KINDS && device->driver->keeps_heat; i++) {
        if (!kept[i].driver || kept[i].driver == device->driver) {
            kept[i].driver = device->driver;
            return &kept[i].motors;
        }
    }
    return NULL;
}

static void copy(const knurl_device *device, const knurl_motor_heat *from, knurl_motor_heat *to) {
    while (__atomic_exchange_n(&held, 1u, __ATOMIC_ACQUIRE)) {}
    knurl_motor_heat *known = find(device);
    if (known) {
        *(to ? to : known) = *(from ? from : known);
    }
    knurl_store_release(&held, 0u);
}

void knurl_motor_heat_keep(const knurl_device *device) {
    if (device->motors.now) {
        copy(device, &device->motors, NULL);
    }
}

void knurl_motor_heat_recall(knurl_device *device) {
    if (!device->motors.now) {
        copy(device, NULL, &device->motors);
    }
}

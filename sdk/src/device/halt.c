/* Halts: no force is sent until the halt is released. SPDX-License-Identifier: MIT */
#include "device/driver.h"

#include "base/atomic.h"

void knurl_device_halt(knurl_device *device) {
    /* The fake device's motors check the flag directly; an I/O thread writes zero within its next exchange. */
    if (KNURL_IS_HANDLE(device, DEVICE)) {
        (void)__atomic_fetch_or(&device->halted, KNURL_HALTED, __ATOMIC_ACQ_REL);
    }
}

void knurl_device_release_halt(knurl_device *device) {
    if (KNURL_IS_HANDLE(device, DEVICE)) {
        (void)__atomic_fetch_and(&device->halted, ~KNURL_HALTED, __ATOMIC_ACQ_REL);
    }
}

uint32_t knurl_device_is_halted(const knurl_device *device) {
    return KNURL_IS_HANDLE(device, DEVICE) && knurl_load_acquire(&device->halted) != 0;
}

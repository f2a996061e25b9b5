/* One interface for all devices: finds the driver, guards the force. SPDX-License-Identifier: MIT */
#include "device/driver.h"

#include "base/atomic.h"
#include "base/base.h"
#include "base/vec3.h"

#include <string.h>

/* The drivers that this version does not have are listed with the reason, so that nobody looks for a cable. */
static const knurl_driver touch = {
    "touch", "3D Systems Touch", "its driver (OpenHaptics, loaded at run time) is not in this version", 0, 0, 0, 0, 0,
    0};
static const knurl_driver falcon = {
    "falcon", "Novint Falcon", "its driver (libusb) is not in this version", 0, 0, 0, 0, 0, 0};
static const knurl_driver rawhid = {
    "rawhid", "raw HID device", "its driver (hidapi) is not in this version", 0, 0, 0, 0, 0, 0};
static const knurl_driver *const drivers[] = {&knurl_fake_driver, &touch, &falcon, &rawhid};

#define DRIVER_COUNT (sizeof drivers / sizeof *drivers)

void knurl_device_info_init(knurl_device_info *info, uint32_t size) {
    const knurl_device_info defaults = {0};
    knurl_desc_write(&defaults, sizeof defaults, info, size);
}

knurl_result knurl_device_open(const char *uri, knurl_device **device) {
    const size_t length = uri ? strcspn(uri, ":") : 0;
    for (size_t i = 0; uri && i < DRIVER_COUNT; i++) {
        const knurl_driver *driver = drivers[i];
        if (strlen(driver->uri) != length || strncmp(driver->uri, uri, length) != 0) {
            continue;
        }
        if (driver->reason[0]) {
            return knurl_fail(KNURL_ERROR_UNSUPPORTED, "device '%s': %s", uri, driver->reason);
        }
        return driver->open(uri[length] == ':' ? uri + length + 1 : "", device);
    }
    return knurl_fail(KNURL_ERROR_UNKNOWN, "device: expected fake, touch, falcon or rawhid, found '%s'",
                      uri ? uri : "(null)");
}

void knurl_device_close(knurl_device *device) {
    if (device) {
        device->driver->close(device);
    }
}

uint32_t knurl_device_list(knurl_device_listing *listings, uint32_t capacity) {
    for (uint32_t i = 0; i < DRIVER_COUNT && i < capacity; i++) {
        listings[i].uri = drivers[i]->uri;
        listings[i].name = drivers[i]->name;
        listings[i].reason = drivers[i]->reason;
    }
    return (uint32_t)DRIVER_COUNT;
}

knurl_result knurl_device_get_info(const knurl_device *device, knurl_device_info *info) {
    knurl_device_info made;
    knurl_device_info_init(&made, sizeof made);
    device->driver->get_info(device, &made);
    return knurl_desc_return("knurl_device_info", &made, sizeof made, info);
}

knurl_result knurl_device_start(knurl_device *device, double update_rate_hz) {
    if (!(update_rate_hz >= 1.0 && update_rate_hz <= 100000.0)) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "update rate: expected 1 to 100000 Hz, found %g Hz", update_rate_hz);
    }
    return device->driver->start(device, update_rate_hz);
}

knurl_result knurl_device_read(knurl_device *device, knurl_device_sample *sample) {
    return device->driver->read(device, sample);
}

knurl_result knurl_device_write(knurl_device *device, const double force[3]) {
    double safe[3] = {0.0, 0.0, 0.0};
    const double length = vec3_length(force);
    if (isfinite(length) && !knurl_load_acquire(&device->halted)) {
        vec3_scale(length > device->max_force ? device->max_force / length : 1.0, force, safe);
    }
    return device->driver->write(device, safe);
}

void knurl_device_halt(knurl_device *device) {
    /* The fake device's motors obey the flag by themselves; a driver with an I/O thread has that thread write zero. */
    knurl_store_release(&device->halted, 1u);
}

void knurl_device_release_halt(knurl_device *device) {
    knurl_store_release(&device->halted, 0u);
}

uint32_t knurl_device_is_halted(const knurl_device *device) {
    return knurl_load_acquire(&device->halted);
}

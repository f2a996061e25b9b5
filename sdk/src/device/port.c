/* The device interface of loops. SPDX-License-Identifier: MIT */
#include "device/port.h"
#include "device/driver.h"

#include "base/atomic.h"
#include "base/vec3.h"

void knurl_device_halt(knurl_device *device) {
    /* The fake device's motors check the flag directly; an I/O thread writes zero within its next exchange. */
    if (KNURL_IS_HANDLE(device, DEVICE)) {
        (void)__atomic_fetch_or(&device->halted, KNURL_HALTED, __ATOMIC_ACQ_REL);
    }
}

void knurl_port_release_halt(knurl_device *device) {
    if (KNURL_IS_HANDLE(device, DEVICE)) {
        (void)__atomic_fetch_and(&device->halted, ~KNURL_HALTED, __ATOMIC_ACQ_REL);
    }
}

uint32_t knurl_port_is_halted(const knurl_device *device) {
    return KNURL_IS_HANDLE(device, DEVICE) && knurl_load_acquire(&device->halted) != 0;
}

int knurl_port_is_lost(const knurl_device *device) {
    return knurl_load_acquire(&device->lost) != 0;
}

void knurl_port_lose(knurl_device *device) {
    knurl_device_halt(device);
    knurl_events_report(&device->events, KNURL_FAULT_LOST, 0.0);
    knurl_store_release(&device->lost, 1u);
}

void knurl_port_report(knurl_device *device, int32_t code, double value) {
    knurl_events_report(&device->events, code, value);
}

int knurl_port_owns_thread(const knurl_device *device) {
    return device->driver->serve != NULL;
}

int knurl_port_can_step(const knurl_device *device) {
    return !device->driver->serve && !device->link;
}

knurl_result knurl_port_serve(knurl_device *device, uint32_t (*tick)(void *argument), void *argument) {
    return device->driver->serve(device, tick, argument);
}

int knurl_port_leave(knurl_device *device) {
    return device->driver->leave && device->driver->leave(device);
}

void knurl_port_add_gap(knurl_device *device, double seconds) {
    device->check.gap += seconds;
}

int knurl_port_may_hold_force(const knurl_device *device) {
    return device->link || !knurl_load_acquire(&device->quiet);
}

void knurl_port_set_torque(knurl_device *device, double gain, const knurl_device_torque *torque) {
    vec3_scale(gain, torque->torque, device->torque);
    device->torque[3] = gain * torque->grip;
}

const char *knurl_port_uri(const knurl_device *device) {
    return device->driver->uri;
}

knurl_motor_heat *knurl_port_motors(knurl_device *device) {
    return &device->motors;
}

/* The device interface of loops, beyond <knurl/device.h>: claims, faults, threads, motor heat.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_PORT_H
#define KNURL_SRC_PORT_H

#include "device/motors.h"

#include <knurl/device.h>

/* s without a tick after which a device that owns the servo thread counts as lost. */
#define KNURL_SERVE_GIVE_UP 1.0

/* Claims the device for one loop, and keeps it from being freed. Errors: KNURL_ERROR_STATE (claimed by another loop, or
 * closed). [any thread] */
knurl_result knurl_device_claim(knurl_device *device);

/* Ends the claim, and closes the device if its owner closed it meanwhile. [not the haptic thread] */
void knurl_device_release(knurl_device *device);

/* claim: the loop is about to start its haptic thread. enter: called on that thread. */
void knurl_device_claim_thread(knurl_device *device);
void knurl_device_enter_thread(knurl_device *device);

/* 1 if its owner has closed it. [any thread] */
int knurl_device_is_closed(const knurl_device *device);

/* 1 while halted; 0 for an invalid handle. [any thread] */
uint32_t knurl_port_is_halted(const knurl_device *device);

/* Ends knurl_device_halt(). [any thread] */
void knurl_port_release_halt(knurl_device *device);

/* 1 unless a halt is set that knurl_port_release_halt() cannot end. [any thread] */
int knurl_device_may_resume(const knurl_device *device);

/* knurl_device_start() for the loop that has claimed the device. */
knurl_result knurl_device_begin(knurl_device *device, double update_rate_hz);

/* Reopens a lost device; KNURL_OK on success. [not the haptic thread, and never during a read or write] */
knurl_result knurl_device_reopen(knurl_device *device);

/* 1 if lost and not yet reopened. [any thread] */
int knurl_port_is_lost(const knurl_device *device);

/* Marks a device as lost, zeroes its force and reports the fault. [any thread] */
void knurl_port_lose(knurl_device *device);

/* Adds a fault (KNURL_FAULT_) to the device's event ring. [any thread, without waiting] */
void knurl_port_report(knurl_device *device, int32_t code, double value);

/* 1 if the device has its own servo thread, which calls the tick (knurl_driver.serve). */
int knurl_port_owns_thread(const knurl_device *device);

/* 1 if reads and writes never wait and may run on any thread. */
int knurl_port_can_step(const knurl_device *device);

/* Makes its servo thread call `tick` once a period until that returns 0. Errors: as knurl_driver.serve. */
knurl_result knurl_port_serve(knurl_device *device, uint32_t (*tick)(void *argument), void *argument);

/* For a device whose servo thread has not called `tick` for long: 1 if `tick` will not be called again before
 * knurl_device_reopen(); 0 if a call is in progress, or if it has no servo thread. [not the haptic thread] */
int knurl_port_leave(knurl_device *device);

/* Adds time (s) without a reading, in which the hand may have moved. [haptic thread] */
void knurl_port_add_gap(knurl_device *device, double seconds);

/* 1 if the device may still play the last force, so that the loop must write a zero at its end. */
int knurl_port_may_hold_force(const knurl_device *device);

/* Sets the torque and the gripper's force, times `gain`, of the next knurl_device_write(). [haptic thread] */
void knurl_port_set_torque(knurl_device *device, double gain, const knurl_device_torque *torque);

/* 1 if it has an I/O thread under the real-time scheduler. [any thread] */
uint32_t knurl_port_is_io_realtime(const knurl_device *device);

/* The driver's name in URIs, for messages; static. */
const char *knurl_port_uri(const knurl_device *device);

/* Heat of its motors: read before a loop starts, written when it ends. */
knurl_motor_heat *knurl_port_motors(knurl_device *device);

/* Motors stay warm while their device is closed: their heat is kept in the process by kind of device (motor_heat.c).
 * Call keep before closing, recall before the first loop. [any thread except the haptic thread] */
void knurl_motor_heat_keep(const knurl_device *device);
void knurl_motor_heat_recall(knurl_device *device);

#endif

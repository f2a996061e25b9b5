/* The device as a loop uses it, beyond <knurl/device.h>: claiming it, its faults, its thread, the heat of its motors.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_PORT_H
#define KNURL_SRC_PORT_H

#include "device/motors.h"

#include <knurl/device.h>

/* s without a tick after which a device that owns the servo thread counts as lost. */
#define KNURL_SERVE_GIVE_UP 1.0

/* Claims the device for one loop, and keeps it from being freed. Errors: KNURL_ERROR_STATE (another loop has it, or it
 * was closed). [any thread] */
knurl_result knurl_device_claim(knurl_device *device);

/* Ends the claim; closes the device if its owner did meanwhile. [not the haptic thread] */
void knurl_device_release(knurl_device *device);

/* The loop is about to start its haptic thread; and the calling thread is it now. */
void knurl_device_claim_thread(knurl_device *device);
void knurl_device_enter_thread(knurl_device *device);

/* 1: its owner has closed it. [any thread] */
int knurl_device_is_closed(const knurl_device *device);

/* 1: no halt but one that knurl_device_release_halt() ends. [any thread] */
int knurl_device_may_resume(const knurl_device *device);

/* knurl_device_start() for the loop that has claimed it. */
knurl_result knurl_device_begin(knurl_device *device, double update_rate_hz);

/* Reopens a lost device. KNURL_OK: it is back. [not the haptic thread, and never during a read or write] */
knurl_result knurl_device_reopen(knurl_device *device);

/* 1: lost, and not found again yet. [any thread] */
int knurl_port_is_lost(const knurl_device *device);

/* Zeroes the force of a device that the loop found to be lost, reports the fault and marks it. [any thread] */
void knurl_port_lose(knurl_device *device);

/* Puts a fault on the device's event ring (KNURL_FAULT_). [any thread, without waiting] */
void knurl_port_report(knurl_device *device, int32_t code, double value);

/* 1: it has a servo thread of its own, which calls the tick (knurl_driver.serve). */
int knurl_port_owns_thread(const knurl_device *device);

/* 1: reads and writes never wait and may run on any thread. */
int knurl_port_can_step(const knurl_device *device);

/* Has its servo thread call `tick` once a period, until that returns 0. Errors: as knurl_driver.serve. */
knurl_result knurl_port_serve(knurl_device *device, uint32_t (*tick)(void *argument), void *argument);

/* When `tick` has not been called for long: 1 where it will not be called again before knurl_device_reopen(); 0 where a
 * call is under way, or where the device has no such thread. [not the haptic thread] */
int knurl_port_leave(knurl_device *device);

/* Adds s without a reading, in which the hand may have moved. [haptic thread] */
void knurl_port_add_gap(knurl_device *device, double seconds);

/* 1: the device may still play the last force, so that the loop must write a zero at its end. */
int knurl_port_may_hold_force(const knurl_device *device);

/* Its URI's first part, for messages; static. */
const char *knurl_port_uri(const knurl_device *device);

/* How warm its motors are: a loop reads it before it starts and writes it when it ends. */
knurl_motor_heat *knurl_port_motors(knurl_device *device);

/* Motors stay warm while their device is closed: kept in the process by kind of device (motor_heat.c). Keep: before it
 * is closed. Recall: before its first loop. [any thread but the haptic] */
void knurl_motor_heat_keep(const knurl_device *device);
void knurl_motor_heat_recall(knurl_device *device);

#endif

/* Reads and writes, above all drivers: checks positions and forces. [haptic thread] SPDX-License-Identifier: MIT */
#include "device/link.h"
#include "device/port.h"

#include "base/atomic.h"
#include "base/base.h"
#include "base/rule.h"
#include "base/vec3.h"

#include <string.h>

/* A force already limited to the maximum may exceed it by rounding; it is sent unchanged. */
#define ROUNDING 1e-15

/* KNURL_OK if a hand can have moved the device to `position`. */
static knurl_result check_position(knurl_device *device, const double position[3]) {
    knurl_position_check *check = &device->check;
    if (!vec3_finite(position)) {
        if (!check->not_finite) {
            knurl_events_report(&device->events, KNURL_FAULT_NOT_FINITE, 0.0);
        }
        check->not_finite = 1;
        check->settle = KNURL_SETTLE_TIME;
        return KNURL_ERROR_DEVICE_NOT_READY;
    }
    if (check->has_last && device->max_speed > 0.0) {
        double moved[3];
        vec3_sub(position, check->last, moved);
        const double distance = vec3_length(moved);
        if (!(distance <= device->max_speed * fmax(check->gap, check->least_gap))) {
            if (check->settle <= 0.0) {
                knurl_events_report(&device->events, KNURL_FAULT_JUMP, distance);
            }
            check->settle = KNURL_SETTLE_TIME;
        }
    }
    vec3_copy(position, check->last);
    check->has_last = 1;
    check->gap = 0.0;
    if (check->settle > 0.0) { /* after a jump, a new position is accepted once it stays */
        check->settle -= device->period;
        return KNURL_ERROR_DEVICE_NOT_READY;
    }
    check->not_finite = 0;
    return KNURL_OK;
}

/* Zeroes a quaternion that is not of unit length. */
static void check_orientation(double q[4]) {
    const double square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
    if (!(square > 0.98 && square < 1.02)) {
        memset(q, 0, 4 * sizeof *q);
    }
}

/* Zeroes angles that are not numbers. */
static void check_angles(knurl_device_sample *sample) {
    const uint32_t room = sizeof sample->joints / sizeof *sample->joints;
    sample->joint_count = sample->joint_count <= room ? sample->joint_count : 0;
    sample->grip = knurl_is_finite(sample->grip) ? sample->grip : 0.0;
    for (uint32_t i = 0; i < room; i++) {
        sample->joints[i] = i < sample->joint_count && knurl_is_finite(sample->joints[i]) ? sample->joints[i] : 0.0;
    }
}

static void publish_pose(knurl_device *device, const knurl_device_sample *sample) {
    double pose[5];
    memcpy(pose, sample->orientation, sizeof sample->orientation);
    pose[4] = sample->grip;
    knurl_seqlock_write(&device->orientation.sequence, device->orientation.words, pose, sizeof pose);
}

static void lose(knurl_device *device) {
    knurl_device_halt(device);
    if (!device->link) { /* an I/O thread has already reported it */
        knurl_events_report(&device->events, KNURL_FAULT_LOST, 0.0);
    }
    knurl_store_release(&device->lost, 1u);
}

static void check_motors(knurl_device *device, const double position[3]) {
    const int backwards = knurl_motor_check_step(&device->motor_check, position);
    if (backwards) {
        (void)__atomic_fetch_or(&device->halted, KNURL_HALTED_BACKWARDS, __ATOMIC_ACQ_REL);
        knurl_events_report(&device->events, KNURL_FAULT_BACKWARDS_X + (backwards - 1), 0.0);
    }
}

static knurl_result read_device(knurl_device *device, knurl_device_sample *sample) {
    if (knurl_load_acquire(&device->lost)) {
        return KNURL_ERROR_DEVICE_LOST;
    }
    knurl_device_sample found;
    memset(&found, 0, sizeof found);
    knurl_result result = device->link ? knurl_link_read(device->link, &found) : device->driver->read(device, &found);
    device->check.gap += device->period;
    result = result ? result : check_position(device, found.position);
    if (!result) {
        if (device->motor_check.is_on) {
            check_motors(device, found.position);
        }
        check_orientation(found.orientation);
        check_angles(&found);
        *sample = found;
        knurl_store_relaxed(&device->buttons, found.buttons);
        publish_pose(device, &found);
        return KNURL_OK;
    }
    if (result == KNURL_ERROR_DEVICE_LOST) {
        lose(device);
    } else if (result != KNURL_ERROR_STATE) {
        knurl_device_halt(device);
    }
    return result;
}

/* Sets the message of a failed read or write. */
static knurl_result with_message(knurl_result result) {
    return result ? knurl_fail_static(result, knurl_result_string(result)) : KNURL_OK;
}

knurl_result knurl_device_read(knurl_device *device, knurl_device_sample *sample) {
    KNURL_RULE(HAPTIC, device);
    if (!KNURL_IS_HANDLE(device, DEVICE) || !sample) {
        return knurl_fail_static(KNURL_ERROR_ARGUMENT,
                                 "knurl_device_read: expected a device that is open and a sample, "
                                 "found null or an invalid handle");
    }
    return with_message(read_device(device, sample));
}

/* Shortens a vector to `most`; one that is shortened already stays as it is. */
static void shorten(const double vector[3], double length, double most, double shortened[3]) {
    vec3_scale(length > most * (1.0 + ROUNDING) ? most / length : 1.0, vector, shortened);
}

/* Takes the torque and the gripper's force for this write. */
static void take_torque(knurl_device *device, double safe[KNURL_FORCES]) {
    const double length = vec3_length(device->torque);
    if (knurl_is_finite(length) && knurl_is_finite(device->torque[3])) {
        shorten(device->torque, length, device->max_torque, safe + 3);
        safe[6] = fmax(-device->max_grip, fmin(device->max_grip, device->torque[3]));
    }
}

static knurl_result write_device(knurl_device *device, const double force[3]) {
    if (knurl_load_acquire(&device->lost)) {
        return KNURL_ERROR_DEVICE_LOST;
    }
    double safe[KNURL_FORCES] = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
    const double length = vec3_length(force);
    if (knurl_is_finite(length) && !knurl_load_acquire(&device->halted)) {
        shorten(force, length, device->max_force, safe);
        take_torque(device, safe);
    }
    memset(device->torque, 0, sizeof device->torque);
    if (device->motor_check.is_on) {
        knurl_motor_check_shape(&device->motor_check, safe);
    }
    if (!device->link) {
        knurl_device_before_force(device, safe);
    }
    const knurl_result result =
        device->link ? knurl_link_write(device->link, safe) : device->driver->write(device, safe);
    if (!result && !device->link && !device->driver->serve) { /* otherwise the sending thread does this */
        knurl_device_after_force(device, safe);
    }
    if (result == KNURL_ERROR_DEVICE_LOST) {
        lose(device);
    }
    return result;
}

knurl_result knurl_device_write(knurl_device *device, const double force[3]) {
    KNURL_RULE(HAPTIC, device);
    if (!KNURL_IS_HANDLE(device, DEVICE) || !force) {
        return knurl_fail_static(KNURL_ERROR_ARGUMENT,
                                 "knurl_device_write: expected a device that is open and a force, "
                                 "found null or an invalid handle");
    }
    return with_message(write_device(device, force));
}

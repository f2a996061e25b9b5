/* Knurl: a device made of a caller's functions, for hardware that Knurl does not support.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_DEVICE_FUNCTIONS_H
#define KNURL_DEVICE_FUNCTIONS_H

#include <knurl/device.h>

#ifdef __cplusplus
extern "C" {
#endif

/** A caller's device. Each function gets `user`. */
typedef struct knurl_device_functions {
    uint32_t struct_size; /**< set by knurl_device_functions_init() */
    uint32_t blocking;    /**< 1: read and write may block. A separate I/O thread calls them in turn; the haptic thread
                             exchanges the newest position and force with it. 0 (default): the haptic thread calls them;
                             nothing zeroes the force while it hangs */
    void *user;
    /** Fills in the properties; max_force must be set. `info` has these defaults: heat_time 60 s, INFINITY in
     * continuous_force and max_stiffness, 0 in all others. max_torque and max_grip stay 0: `write` gets no torque.
     * Required. Do not call knurl_device_info_init(). [any thread] */
    void (*get_info)(void *user, knurl_device_info *info);
    /** Prepares for this rate of reads; or null. Called before the first read, and, if blocking, also later while the
     * I/O thread is reading. [game thread] */
    knurl_result (*start)(void *user, double update_rate_hz);
    /** Fills in the newest position; the sample is zeroed before. Required. Returns KNURL_OK,
     * KNURL_ERROR_DEVICE_NOT_READY (no position this time: the last one is used for up to 10 ms, then the device is
     * reported as silent) or KNURL_ERROR_DEVICE_LOST. [haptic thread; if blocking, the I/O thread: it should return
     * within 5 ms, and after 1 s without a position the device is lost] */
    knurl_result (*read)(void *user, knurl_device_sample *sample);
    /** Applies a force, finite and at most max_force. Required. Returns KNURL_OK or KNURL_ERROR_DEVICE_LOST. [as read;
     * also once at the end, on the closing thread] */
    knurl_result (*write)(void *user, const double force[3]);
    /** Tries to find a lost device again; null if that is not possible. Returns KNURL_OK or KNURL_ERROR_DEVICE_LOST. [a
     * thread of the loop, while nothing is read or written] */
    knurl_result (*reopen)(void *user);
    /** Frees the device; or null. It is the last call. [the thread that closes the device, or that destroys the last
     * loop that uses it] */
    void (*close)(void *user);
    uint32_t motors_known; /**< 1: the motors are known to push in the right direction and are not checked, see
                              knurl_device_open(). Default 0 */
    uint32_t reserved;     /**< 0 */
} knurl_device_functions;

/** Sets struct_size and the defaults; `size` is the caller's sizeof. [any thread] */
KNURL_API void knurl_device_functions_init(knurl_device_functions *functions, uint32_t size);

/** Opens a device made of a caller's functions. Its positions are checked like any device's: a position that is not
 * finite, or moves faster than 10 m/s, is a fault. Errors: KNURL_ERROR_ARGUMENT, KNURL_ERROR_MEMORY, KNURL_ERROR_SYSTEM
 * (no thread). [game thread] */
KNURL_API knurl_result knurl_device_open_functions(const knurl_device_functions *functions, knurl_device **device);

#ifdef __cplusplus
}
#endif
#endif

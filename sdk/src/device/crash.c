/* When the process ends by a signal: no force any more, as long as the threads that write to devices still run.
 * SPDX-License-Identifier: MIT */
#include "base/atomic.h"
#include "base/system.h"
#include "device/driver.h"

/* More devices than anyone has on the desk; one beyond it is not waited for, but obeys knurl_device_ends() as well. */
#define DEVICE_ROOM 16

/* How long a signal waits for the threads that write: an I/O thread's exchange takes 5 ms at most. */
#define WAIT_NS 20000000

static knurl_device *open_devices[DEVICE_ROOM]; /* atomics */
static uint32_t ends;                           /* atomic */

uint32_t knurl_device_ends(void) {
    return __atomic_load_n(&ends, __ATOMIC_SEQ_CST);
}

static int is_none(const double force[3]) {
    return force[0] == 0.0 && force[1] == 0.0 && force[2] == 0.0;
}

/* Whoever sends looks at `ends` after having cleared `quiet`, and the signal looks at `quiet` after having set `ends`:
 * one of them sees the other. */
void knurl_device_before_force(knurl_device *device, double force[3]) {
    if (!is_none(force)) {
        __atomic_store_n(&device->quiet, 0u, __ATOMIC_SEQ_CST);
        if (knurl_device_ends()) {
            force[0] = force[1] = force[2] = 0.0;
        }
    }
}

void knurl_device_after_force(knurl_device *device, const double force[3]) {
    if (is_none(force)) {
        knurl_store_release(&device->quiet, 1u);
    }
}

void knurl_device_register(knurl_device *device) {
    if (!device->link) { /* an I/O thread tells by itself */
        knurl_store_release(&device->quiet, 1u);
    }
    for (int i = 0; i < DEVICE_ROOM; i++) {
        knurl_device *none = NULL;
        if (__atomic_compare_exchange_n(&open_devices[i], &none, device, 0, __ATOMIC_ACQ_REL, __ATOMIC_RELAXED)) {
            return;
        }
    }
}

void knurl_device_unregister(knurl_device *device) {
    for (int i = 0; i < DEVICE_ROOM; i++) {
        knurl_device *mine = device;
        (void)__atomic_compare_exchange_n(&open_devices[i], &mine, NULL, 0, __ATOMIC_ACQ_REL, __ATOMIC_RELAXED);
    }
}

static int all_quiet(void) {
    for (int i = 0; i < DEVICE_ROOM; i++) {
        const knurl_device *device = knurl_load_acquire(&open_devices[i]);
        if (device && !__atomic_load_n(&device->quiet, __ATOMIC_SEQ_CST) && !knurl_load_acquire(&device->lost)) {
            return 0;
        }
    }
    return 1;
}

/* In a signal handler: nothing but atomics, the clock and naps. */
static void let_go(void) {
    const int64_t until = knurl_system_now_ns() + WAIT_NS;
    __atomic_store_n(&ends, 1u, __ATOMIC_SEQ_CST);
    while (!all_quiet() && knurl_system_now_ns() < until) {
        knurl_system_sleep_until_ns(knurl_system_now_ns() + 200000);
    }
}

knurl_result knurl_device_let_go_on_crash(void) {
    return knurl_system_on_crash(let_go) ? KNURL_OK
                                         : knurl_fail(KNURL_ERROR_SYSTEM, "the system refused a handler of signals");
}

/* Zeroes all forces when the process ends or stops. SPDX-License-Identifier: MIT */
#include "base/atomic.h"
#include "base/rule.h"
#include "base/system.h"
#include "device/driver.h"

#include <math.h>
#include <string.h>

/* More devices than fit on a desk. The force of any further device is zeroed at the end too, but not waited for. */
#define DEVICE_ROOM 16

/* ns that the end of the process waits for sending threads: an I/O thread's exchange takes at most 5 ms. */
#define WAIT_NS 20000000

/* Bits of `reasons`; the upper bits count stops in progress. */
#define ENDING   1u
#define ONE_STOP 2u

static knurl_device *open_devices[DEVICE_ROOM]; /* atomics */
static uint32_t reasons;                        /* atomic; if 0, forces may be sent */

uint32_t knurl_device_must_be_zero(void) {
    return __atomic_load_n(&reasons, __ATOMIC_SEQ_CST) != 0;
}

int knurl_force_is_zero(const double force[KNURL_FORCES]) {
    double sum = 0.0;
    for (int i = 0; i < KNURL_FORCES; i++) {
        sum += fabs(force[i]);
    }
    return sum == 0.0;
}

/* A sending thread clears `quiet`, then reads `reasons` and `halted`; a thread that ends the process or closes the
 * device sets one of these, then reads `quiet`. So at least one of the two threads sees the other's store. */
void knurl_device_before_force(knurl_device *device, double force[KNURL_FORCES]) {
    if (!knurl_force_is_zero(force)) {
        if (knurl_load_relaxed(&device->quiet)) { /* written by this thread only */
            __atomic_store_n(&device->quiet, 0u, __ATOMIC_SEQ_CST);
        }
        if (knurl_device_must_be_zero() || __atomic_load_n(&device->halted, __ATOMIC_SEQ_CST)) {
            memset(force, 0, KNURL_FORCES * sizeof *force);
        }
    }
}

void knurl_device_after_force(knurl_device *device, const double force[KNURL_FORCES]) {
    if (knurl_force_is_zero(force)) {
        knurl_store_release(&device->quiet, 1u);
    }
}

void knurl_device_register(knurl_device *device) {
    if (!device->link) { /* an I/O thread sets it itself */
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

static void halt_all(void) {
    for (int i = 0; i < DEVICE_ROOM; i++) {
        knurl_device *device = knurl_load_acquire(&open_devices[i]);
        if (device) {
            knurl_device_halt(device);
        }
    }
}

/* The functions below may run in a signal handler: only atomics, the clock and sleeps. */
static void zero_now(void) {
    const int64_t until = knurl_system_now_ns() + WAIT_NS;
    while (!all_quiet() && knurl_system_now_ns() < until) {
        knurl_system_sleep_until_ns(knurl_system_now_ns() + 200000);
    }
}

static void end(void) {
    (void)__atomic_fetch_or(&reasons, ENDING, __ATOMIC_SEQ_CST);
    zero_now();
}

static void stop(void) {
    (void)__atomic_fetch_add(&reasons, ONE_STOP, __ATOMIC_SEQ_CST);
    zero_now();
}

static void resume(void) {
    halt_all(); /* so that forces ramp up again */
    (void)__atomic_fetch_sub(&reasons, ONE_STOP, __ATOMIC_SEQ_CST);
}

knurl_result knurl_device_zero_on_exit(uint32_t faults_recover) {
    KNURL_RULE(GAME, NULL);
    static const knurl_exit_actions actions = {end, stop, resume};
    if (faults_recover > 1) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "knurl_device_zero_on_exit: expected 0 or 1, found %u",
                          (unsigned)faults_recover);
    }
    return knurl_system_on_exit(&actions, (int)faults_recover)
               ? KNURL_OK
               : knurl_fail(KNURL_ERROR_SYSTEM, "the system refused a handler of signals or of exit()");
}

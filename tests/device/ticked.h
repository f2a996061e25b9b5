/* A device over its double, ticked as a loop does without its protections; the test's teardown closes it.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_TICKED_H
#define KNURL_TEST_TICKED_H

#include "support/close.h"
#include "support/wait.h"

#include "device/driver.h"
#include "device/port.h"

#include <knurl/device.h>

static knurl_device *device;
static knurl_device_sample latest; /* reading */
static const double none[3];

/** Reads, and writes `force`, once a millisecond. Returns the last reading's result. */
static inline knurl_result run(int ms, const double force[3]) {
    knurl_result result = KNURL_OK;
    for (int i = 0; i < ms; i++) {
        result = knurl_device_read(device, &latest);
        (void)knurl_device_write(device, force);
        sleep_ms(1.0);
    }
    return result;
}

/** Until positions have come: a device is halted before. */
static inline void run_released(void) {
    if (!device) {
        fail_msg("%s", knurl_error_message());
    }
    (void)run(30, none);
    knurl_port_release_halt(device);
}

static inline int close_device(void **state) {
    (void)state;
    knurl_device_close(device);
    device = NULL;
    return 0;
}

#endif

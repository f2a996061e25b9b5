/* Ticks of a device in real time, as a loop makes them. SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_TICKING_H
#define KNURL_TEST_TICKING_H

#include <knurl/device.h>

#include "support/wait.h"

/* Reads and writes `force` at 1 kHz or slower until a read returns `result`: 1; or 0 after `seconds`. */
static inline int tick_device_until(knurl_device *device, knurl_result result, const double force[3], double seconds,
                                    knurl_device_sample *sample) {
    const int64_t until = knurl_system_now_ns() + (int64_t)(seconds * 1e9);
    do {
        if (knurl_device_read(device, sample) == result) {
            return 1;
        }
        (void)knurl_device_write(device, force);
        sleep_ms(1.0);
    } while (knurl_system_now_ns() < until);
    return 0;
}

#endif

/* Waiting on the program's clock, which simulates time if the program is linked with virtual_time.c.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_WAIT_H
#define KNURL_TEST_WAIT_H

#include "support/suite.h"

#include "base/system.h"

static inline void sleep_ms(double ms) {
    knurl_system_sleep_until_ns(knurl_system_now_ns() + (int64_t)(ms * 1e6));
}

/** Waits until `condition` is true; fails after 20 s. */
#define WAIT_FOR(condition)                                                                                            \
    do {                                                                                                               \
        const int64_t until_ = knurl_system_now_ns() + INT64_C(20000000000);                                           \
        while (!(condition)) {                                                                                         \
            if (knurl_system_now_ns() > until_) {                                                                      \
                fail_msg("not within 20 s: %s", #condition);                                                           \
            }                                                                                                          \
            sleep_ms(0.2);                                                                                             \
        }                                                                                                              \
    } while (0)

#endif

/* Own methods that copy the paper's, from its formulas. SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_OWN_H
#define KNURL_TEST_OWN_H

#include "support/close.h"

#include <knurl/grating.h>

/** Adds a method, unless an earlier test did. */
static inline int32_t own_add(const char *name, double crest, knurl_method_function height, void *user) {
    int32_t method = 0;
    if (knurl_method_from_name(name, &method)) {
        assert_int_equal(knurl_method_add(name, crest, height, user, &method), KNURL_OK);
    }
    assert_string_equal(knurl_method_name(method), name);
    return method;
}

/** Eq. 11. */
static inline double own_s1(const knurl_method_input *in, double *memory, void *user) KNURL_NONBLOCKING {
    const double x = in->cycles[0] + 0.25 - floor(in->cycles[0] + 0.25);
    const double y = in->cycles[1] + 0.25 - floor(in->cycles[1] + 0.25);
    (void)memory, (void)user;
    return (x < 0.5) == (y < 0.5) ? 1.0 : -1.0;
}

/** Algorithm 7 with events of 3 ticks and more, and no deadband. memory: the event's length and next tick. */
static inline double own_s2(const knurl_method_input *in, double *memory, void *user) KNURL_NONBLOCKING {
    (void)user;
    if (memory[1] == memory[0]) {
        memory[0] = floor(1.0 / (in->temporal_frequency * in->period) + 0.5);
        memory[1] = 0.0;
    }
    const double n = memory[0], k = memory[1]++, up = ceil(0.5 * n), down = n - up;
    return k < up ? sqrt(down / up) : -sqrt(up / down);
}

#endif

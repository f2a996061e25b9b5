/* FOAW (Janabi-Sharifi, Hayward and Chen 2000), with a backlash before it and slopes by thirds, by brute force, as the
 * tests' measure of sdk/src/motion.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_FOAW_H
#define KNURL_TEST_FOAW_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>

/** Fixed-point steps in a count. */
#define STEPS INT64_C(1024)

/** A backlash of one count: the held value moves only as far as needed to stay within half a count of each position. */
static inline void brute_backlash(const int64_t *x, int64_t *held, size_t count) {
    for (size_t k = 0; k < count; k++) {
        held[k] = k == 0 ? x[0] : held[k - 1];
        while (x[k] - held[k] > STEPS / 2) {
            held[k] += x[k] - held[k] - STEPS / 2;
        }
        while (held[k] - x[k] > STEPS / 2) {
            held[k] -= held[k] - x[k] - STEPS / 2;
        }
    }
}

/** Do all samples of a window lie within one count (inclusive) of the line through its newest and its oldest? */
static inline int brute_fits(const int64_t *x, size_t newest, size_t stride, size_t window) {
    const int64_t n = (int64_t)window;
    for (size_t inside = 1; inside < window; inside++) {
        const int64_t i = (int64_t)inside;
        const int64_t line = x[newest] * (n - i) + x[newest - window * stride] * i; /* times n */
        const int64_t off = n * x[newest - inside * stride] - line;
        if (off > n * STEPS || -off > n * STEPS) {
            return 0;
        }
    }
    return 1;
}

/** Of those windows that are tried, the widest that fits; 0 on the first tick. x: held positions of one axis, in
 * 1024ths of a count, the newest last; samples are `stride` ticks apart. */
static inline size_t brute_window(const int64_t *x, size_t newest, size_t stride) {
    static const size_t tried[] = {15, 11, 8, 6, 4, 3, 2, 1};
    for (size_t i = 0; i < sizeof tried / sizeof *tried; i++) {
        if (tried[i] * stride <= newest && brute_fits(x, newest, stride, tried[i])) {
            return tried[i];
        }
    }
    return 0;
}

/** The velocity in counts a sample: the mean of the window's newest third less that of its oldest, over the time
 * between their middles. A third is the whole number nearest to it. */
static inline long double brute_foaw(const int64_t *x, size_t newest, size_t stride) {
    const size_t window = brute_window(x, newest, stride);
    if (window == 0) {
        return 0.0L;
    }
    const size_t third = (size_t)floor(((double)window + 1.0) / 3.0 + 0.5);
    const size_t apart = window + 1 - third; /* samples from middle to middle */
    int64_t sum = 0;
    for (size_t i = 0; i < third; i++) {
        sum += x[newest - i * stride] - x[newest - (window - i) * stride];
    }
    return (long double)sum / ((long double)third * (long double)apart * (long double)STEPS);
}

#endif

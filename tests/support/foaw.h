/* FOAW (Janabi-Sharifi, Hayward and Chen 2000) by brute force, as the tests' measure of sdk/src/motion.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_FOAW_H
#define KNURL_TEST_FOAW_H

#include <knurl/motion.h>

/** Fixed-point steps in a count. */
#define STEPS INT64_C(1024)

/** A brute-force FOAW on integers: all positions of one axis, in 1024ths of a count, the newest last. Looks for the
 * widest window, up to 15 ticks, in which every sample lies within one count (inclusive) of the line through the newest
 * and the oldest; gives the slope of that line in counts a tick. */
static inline long double brute_foaw(const int64_t *x, size_t newest) {
    size_t window = newest < KNURL_FOAW_WINDOW ? newest : KNURL_FOAW_WINDOW;
    for (; window > 1; window--) {
        const int64_t n = (int64_t)window;
        size_t inside = 1;
        while (inside < window) {
            const int64_t i = (int64_t)inside;
            const int64_t line = x[newest] * (n - i) + x[newest - window] * i; /* times n */
            const int64_t off = n * x[newest - inside] - line;
            if (off > n * STEPS || -off > n * STEPS) {
                break;
            }
            inside++;
        }
        if (inside == window) {
            break;
        }
    }
    return window == 0 ? 0.0L
                       : (long double)(x[newest] - x[newest - window]) / ((long double)window * (long double)STEPS);
}

#endif

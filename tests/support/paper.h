/* The paper's Algorithms 1 to 6 once more, word for word, as the tests' measure of sdk/src/vibration and grating.
 * Periods are integers, in thousandths of a tick, and all decisions are made on integers; heights are long doubles.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_PAPER_H
#define KNURL_TEST_PAPER_H

#include <math.h>
#include <stdint.h>

/** Algorithms 1 and 2 with N = p/q ticks: +1 if (k mod N) < N/2, otherwise -1. p and q below 2^31. */
static inline int paper_square(uint64_t tick, uint64_t p, uint64_t q) {
    return 2 * ((tick % p) * q % p) < p ? 1 : -1;
}

/** round(T/T_h), half up. */
static inline int64_t paper_round(int64_t milliticks) {
    return (milliticks + 500) / 1000;
}

/** Algorithm 4 for an odd N: Eq. 7 with Tp = ceil(N/2), Tn = floor(N/2). */
static inline long double paper_odd(uint64_t tick, int64_t length, long double amplitude) {
    const long double n = (long double)length;
    const long double tp = (long double)((length + 1) / 2);
    const long double tn = (long double)(length / 2);
    if ((int64_t)(tick % (uint64_t)length) < (length + 1) / 2) {
        return amplitude * sqrtl(n * tn / (tp * tp + tn * tp));
    }
    return -amplitude * sqrtl(n * tp / (tn * tn + tn * tp));
}

/** Algorithm 5: the 400 Hz case. */
static inline long double paper_mixed(uint64_t tick, long double amplitude) {
    const long double even = 2.0L * amplitude / sqrtl(13.0L);
    const long double odd = 3.0L * amplitude / sqrtl(13.0L);
    return even * (long double)paper_square(tick, 2, 1) + paper_odd(tick, 3, odd);
}

/** Algorithm 6: Ta in ticks. */
static inline int64_t paper_t3_length(int64_t milliticks) {
    if (milliticks < 2250) {
        return 2;
    }
    return milliticks <= 2750 ? 6 : paper_round(milliticks);
}

/** Algorithm 6: the signal. */
static inline long double paper_t3(uint64_t tick, int64_t milliticks, long double amplitude) {
    const int64_t length = paper_t3_length(milliticks);
    if (milliticks >= 2250 && milliticks <= 2750) {
        return paper_mixed(tick, amplitude);
    }
    if (length % 2 != 0) {
        return paper_odd(tick, length, amplitude);
    }
    return amplitude * (long double)paper_square(tick, (uint64_t)length, 1);
}

/** Algorithm 3: the even periods above and below, in ticks. */
static inline int64_t paper_t2_above(int64_t milliticks) {
    return 2 * ((milliticks + 1999) / 2000);
}

static inline int64_t paper_t2_below(int64_t milliticks) {
    return 2 * (milliticks / 2000);
}

/** Algorithm 3 with Eqs. 3 and 4; one even component if the two periods are equal. */
static inline long double paper_t2(uint64_t tick, int64_t milliticks, long double amplitude) {
    const int64_t above = paper_t2_above(milliticks);
    const int64_t below = paper_t2_below(milliticks);
    const long double first = (long double)paper_square(tick, (uint64_t)above, 1);
    const long double second = (long double)paper_square(tick, (uint64_t)below, 1);
    const long double a = (long double)above * (long double)(milliticks - 1000 * below);
    const long double b = (long double)below * (long double)(1000 * above - milliticks);
    if (above == below) {
        return amplitude * first;
    }
    return amplitude * (a * first + b * second) / sqrtl(a * a + b * b);
}

/** The actual period of Algorithm 3's sum in ticks: the least common multiple of its parts' (2m and 2m + 2). */
static inline int64_t paper_t2_length(int64_t milliticks) {
    const int64_t above = paper_t2_above(milliticks);
    const int64_t below = paper_t2_below(milliticks);
    return above == below ? above : above * below / 2;
}

#endif

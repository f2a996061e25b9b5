/* GCC's and Clang's vectors of two lanes, native in SSE2 and NEON. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_PAIR_H
#define KNURL_SRC_PAIR_H

#include <stdint.h>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

typedef double pair __attribute__((vector_size(16)));
typedef int64_t pair_mask __attribute__((vector_size(16)));

static inline pair choose(pair_mask which, pair yes, pair no) {
    return (pair)((which & (pair_mask)yes) | (~which & (pair_mask)no));
}

/* Minimum and maximum are one instruction each on x86, but compilers do not generate it by themselves. If either number
 * is NaN, the result is b. */
static inline pair lesser(pair a, pair b) {
#if defined(__SSE2__)
    return _mm_min_pd(a, b);
#else
    return choose(a < b, a, b);
#endif
}

static inline pair greater(pair a, pair b) {
#if defined(__SSE2__)
    return _mm_max_pd(a, b);
#else
    return choose(a > b, a, b);
#endif
}

#endif

/* Checks the compiler's arithmetic; tests for finite numbers that work under any compiler flags. Every source includes
 * this.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_FINITE_H
#define KNURL_SRC_FINITE_H

#include <float.h>
#include <stdint.h>
#include <string.h>

/* __FAST_MATH__: -ffast-math or -Ofast; the next three: parts of it; _M_FP_FAST: /fp:fast. */
#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__ > 0) ||                           \
    defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__) || defined(_M_FP_FAST)
#error                                                                                                                 \
    "Knurl must be compiled without -ffast-math, -Ofast and their parts: with them a position that is not a number \
becomes a force, and gratings lose their ridges. Add -fno-fast-math after your own flags, for Knurl's sources alone \
(Knurl's CMakeLists.txt does that by itself)."
#endif

/* 0: every type is evaluated as itself. 16: the same, _Float16 included. */
#if FLT_EVAL_METHOD != 0 && FLT_EVAL_METHOD != 16
#error                                                                                                                 \
    "Knurl must be compiled with doubles that are computed as doubles (FLT_EVAL_METHOD 0): with x87's longer ones S1 \
is on the wrong side of its ridges. On x86 add -msse2 -mfpmath=sse (Knurl's CMakeLists.txt does that by itself)."
#endif

/* Tests the bits: no compiler flag can optimise that away, and it raises no floating-point exception. */
static inline int knurl_is_finite(double value) {
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    return (bits & UINT64_C(0x7ff0000000000000)) != UINT64_C(0x7ff0000000000000);
}

/* Finite, and from `least` to `most`. */
static inline int knurl_is_within(double value, double least, double most) {
    return knurl_is_finite(value) && value >= least && value <= most;
}

#endif

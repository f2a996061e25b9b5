/* Four floats at a time. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_FLOAT4_H
#define KNURL_SRC_FLOAT4_H

#include <stdint.h>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

/* GCC and Clang vectors: x, y, z and an unused number. */
typedef float knurl_float4 __attribute__((vector_size(16)));
typedef int32_t knurl_mask4 __attribute__((vector_size(16)));

/* The smaller and the greater of each two numbers; `b` if one is NaN. */
static inline knurl_float4 knurl_float4_min(knurl_float4 a, knurl_float4 b) {
#if defined(__SSE2__)
    return _mm_min_ps(a, b);
#else
    const knurl_mask4 less = a < b;
    return (knurl_float4)(((knurl_mask4)a & less) | ((knurl_mask4)b & ~less));
#endif
}

static inline knurl_float4 knurl_float4_max(knurl_float4 a, knurl_float4 b) {
#if defined(__SSE2__)
    return _mm_max_ps(a, b);
#else
    const knurl_mask4 more = a > b;
    return (knurl_float4)(((knurl_mask4)a & more) | ((knurl_mask4)b & ~more));
#endif
}

static inline knurl_float4 knurl_float4_all(float a) {
    return (knurl_float4){a, a, a, a};
}

/* Bit k: the comparison of the numbers k is true. */
static inline uint32_t knurl_mask4_bits(knurl_mask4 mask) {
#if defined(__SSE2__)
    return (uint32_t)_mm_movemask_ps((__m128)mask);
#else
    return ((uint32_t)mask[0] & 1u) | ((uint32_t)mask[1] & 2u) | ((uint32_t)mask[2] & 4u) | ((uint32_t)mask[3] & 8u);
#endif
}

/* 1 if a comparison is true in x, y or z. */
static inline int knurl_mask4_any(knurl_mask4 mask) {
#if defined(__SSE2__)
    return (_mm_movemask_ps((__m128)mask) & 7) != 0;
#else
    return (mask[0] | mask[1] | mask[2]) != 0;
#endif
}

#endif

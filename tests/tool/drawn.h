/* Patterns drawn by their formulas, for the search for ridges. SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_DRAWN_H
#define KNURL_TEST_DRAWN_H

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

#define DRAWN_TURN 6.283185307179586

enum { DRAWN_SINE, DRAWN_SQUARE, DRAWN_SAW, DRAWN_NO_FUNDAMENTAL };

/* Ridges: samples from one to the next, and the direction across them in degrees from right, counter-clockwise. */
typedef struct drawn_axis {
    double apart, degrees;
    int shape;
} drawn_axis;

/* cos and sin are exact enough: the tests' limits are 1e-3. */
static inline double drawn_phase(const drawn_axis *a, double x, double y) {
    const double turn = DRAWN_TURN * a->degrees / 360.0;
    return (x * cos(turn) - y * sin(turn)) / a->apart + 0.3;
}

/* -1 to 1. */
static inline double drawn_height(const drawn_axis *a, double x, double y) {
    const double phase = drawn_phase(a, x, y), in = phase - floor(phase);
    switch (a->shape) {
    case DRAWN_SQUARE:
        return in < 0.5 ? 1.0 : -1.0;
    case DRAWN_SAW:
        return 2.0 * in - 1.0;
    case DRAWN_NO_FUNDAMENTAL: /* the second and the third harmonic */
        return 0.5 * (sin(2.0 * DRAWN_TURN * phase) + sin(3.0 * DRAWN_TURN * phase + 1.0));
    default:
        return sin(DRAWN_TURN * phase);
    }
}

/* xorshift64*: the same numbers everywhere. */
static inline double drawn_uniform(uint64_t *state) {
    *state ^= *state >> 12;
    *state ^= *state << 25;
    *state ^= *state >> 27;
    return (double)((*state * 2685821657736338717U) >> 11) / 9007199254740992.0;
}

/* Variance 1. */
static inline double drawn_normal(uint64_t *state) {
    const double r = sqrt(-2.0 * log(1.0 - drawn_uniform(state)));
    return r * cos(DRAWN_TURN * drawn_uniform(state));
}

/* Midpoint displacement on a torus of `size`, a power of two: power falls as about 1/f^(2 roughness + 2) in the plane.
 * Variance 1. */
static inline float *drawn_fractal(uint32_t size, double roughness, uint64_t *state) {
    float *at = calloc((size_t)size * size, sizeof *at);
    double sum = 0.0, squares = 0.0;
    for (uint32_t step = size, mask = size - 1; step > 1 && at; step /= 2) {
        const double spread = pow((double)step / size, roughness);
        const uint32_t half = step / 2;
        for (uint32_t y = 0; y < size; y += step) {
            for (uint32_t x = 0; x < size; x += step) { /* the middles of squares */
                const uint32_t right = (x + step) & mask, below = (y + step) & mask;
                const float mean =
                    0.25F * (at[y * size + x] + at[y * size + right] + at[below * size + x] + at[below * size + right]);
                at[(y + half) * size + x + half] = mean + (float)(spread * drawn_normal(state));
            }
        }
        for (uint32_t y = 0; y < size; y += half) { /* and of their sides */
            for (uint32_t x = y % step ? 0 : half; x < size; x += step) {
                const float mean = 0.25F * (at[y * size + ((x + half) & mask)] + at[y * size + ((x - half) & mask)] +
                                            at[((y + half) & mask) * size + x] + at[((y - half) & mask) * size + x]);
                at[y * size + x] = mean + (float)(spread * 0.7 * drawn_normal(state));
            }
        }
    }
    for (size_t i = 0; i < (size_t)size * size && at; i++) {
        sum += (double)at[i];
        squares += (double)at[i] * (double)at[i];
    }
    const double mean = sum / size / size, deviation = sqrt(squares / size / size - mean * mean);
    for (size_t i = 0; i < (size_t)size * size && at; i++) {
        at[i] = (float)(((double)at[i] - mean) / deviation);
    }
    return at;
}

#endif

/* Velocity estimators: first difference, and first-order adaptive windowing (FOAW; Janabi-Sharifi, Hayward and Chen
 * 2000) on integers stored in doubles.
 * SPDX-License-Identifier: MIT */
#include "motion/velocity.h"

#include "base/finite.h"
#include "base/handle.h"
#include "base/rule.h"
#include "motion/pair.h"

#include <math.h>
#include <string.h>

#if defined(__x86_64__) && defined(__GNUC__) && !defined(KNURL_NO_SIMD)
#include <immintrin.h>
#define AVX 1
#else
#define AVX 0
#endif

/* Positions become fixed point with this many steps a count: positions on an encoder's counts stay exact, others (a
 * device that computes millimetres from joint angles) are rounded far below their own noise. */
#define STEPS_PER_COUNT 1024

/* Half a count to either side: a backlash of one count. */
#define HALF_COUNT (0.5 * STEPS_PER_COUNT)

/* 16 positions are kept: the newest and the 15 before it. */
#define RING (KNURL_FOAW_WINDOW + 1)

/* lcm(1..15): slopes over 1 to 15 samples, scaled by it, are integers. Samples often lie exactly one count off the
 * line; if such ties were rounded, a third of all ticks would choose the wrong window. While positions in the window
 * differ by less than 2^34 steps (2^24 counts), slopes and slacks stay below 2^53 and no operation here rounds; beyond
 * that ties are decided to a relative 2^-53, and nothing overflows. */
#define LCM 360360.0

/* A missing position: outside any slope interval, and finite, so that no floating-point exception is raised even if the
 * host enables traps. */
#define UNSEEN 1e300

/* A tracked position's mean velocity is off a new one by at most a count in this many samples. FOAW's is off by up to a
 * count in 11 samples, the way between its thirds; with a count in 15 samples false tones on 0.5 mm ridges are .044
 * instead of .029 (`knurl study tracking`). */
#define MEAN_TICKS 10.0

typedef char state_fits[sizeof(knurl_velocity_state) <= sizeof(knurl_velocity) ? 1 : -1];

/* Ticks between samples: a millisecond. */
static uint32_t stride_at(double rate) {
    const double ticks = floor(rate / 1000.0 + 0.5);
    return ticks < 1.0 ? 1 : ticks < KNURL_FOAW_STRIDE_MAX ? (uint32_t)ticks : KNURL_FOAW_STRIDE_MAX;
}

knurl_result knurl_velocity_prepare(int32_t method, double resolution, double update_rate_hz,
                                    knurl_velocity *velocity) {
    if (KNURL_IS_NULL(velocity)) {
        return KNURL_ERROR_ARGUMENT;
    }
    if (method < KNURL_VELOCITY_AUTO || method > KNURL_VELOCITY_FOAW) {
        return knurl_fail(KNURL_ERROR_UNKNOWN, "velocity method: expected AUTO, DIFFERENCE or FOAW, found %d",
                          (int)method);
    }
    if (!knurl_is_within(resolution, 0.0, 1.0)) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "resolution: expected 0 to 1 m, found %g m", resolution);
    }
    if (!knurl_is_within(update_rate_hz, 1.0, 100000.0)) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "update rate: expected 1 to 100000 Hz, found %g Hz", update_rate_hz);
    }
    if (method == KNURL_VELOCITY_AUTO) {
        method = resolution > 0.0 ? KNURL_VELOCITY_FOAW : KNURL_VELOCITY_DIFFERENCE;
    }
    if (method == KNURL_VELOCITY_FOAW && !(resolution >= 1e-9)) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "resolution: FOAW expects at least 1e-9 m, found %g m", resolution);
    }
    memset(velocity, 0, sizeof *velocity);
    knurl_velocity_state *state = knurl_velocity_get_state(velocity);
    state->method = method;
    state->rate = update_rate_hz;
    state->period = 1.0 / update_rate_hz;
    state->half_count = 0.5 * resolution;
    state->mean_share = fmin(1.0, state->period / KNURL_TRACK_S);
    state->mean_off = resolution * update_rate_hz / (MEAN_TICKS * stride_at(update_rate_hz));
    if (method == KNURL_VELOCITY_FOAW) {
        state->stride = stride_at(update_rate_hz);
        state->steps_per_m = STEPS_PER_COUNT / resolution;
        state->slope_unit = resolution / STEPS_PER_COUNT * update_rate_hz / state->stride;
#if AVX
        state->avx = __builtin_cpu_supports("avx") != 0;
#endif
    }
    return KNURL_OK;
}

static void difference(knurl_velocity_state *velocity, const double position[3], double out[3]) {
    for (int axis = 0; axis < 3; axis++) {
        out[axis] = velocity->started ? (position[axis] - velocity->last[axis]) * velocity->rate : 0.0;
        velocity->last[axis] = position[axis];
    }
    velocity->started = 1;
}

/* Larger than any slope between positions, smaller than any slope to UNSEEN. */
#define ANY_SLOPE 1e304

/* A table of f(i) over windows; index 0 is not used. */
#define WINDOWS(f)                                                                                                     \
    {f(1), f(1), f(2), f(3), f(4), f(5), f(6), f(7), f(8), f(9), f(10), f(11), f(12), f(13), f(14), f(15)}
#define SCALE(i) (LCM / (i))
static const double scales[RING] = WINDOWS(SCALE);

/* Positions (NaN too) are clamped to it, so that everything is finite. */
#define LIMIT 1099511627776.0    /* 2^40 steps */
#define WHOLE 6755399441055744.0 /* 3 * 2^51: adding and subtracting it rounds half to even */

/* Clears all rings and their mirrors. `position` becomes the held one, in the middle of its backlash. */
static void forget(knurl_velocity_state *velocity, const double position[3]) {
    for (uint32_t phase = 0; phase < velocity->stride; phase++) {
        for (int i = 0; i < 2 * RING; i++) {
            double *row = velocity->history[phase][i];
            row[0] = row[1] = row[2] = UNSEEN;
            row[3] = 0.0;
        }
    }
    for (int axis = 0; axis < 3; axis++) {
        const double steps = position[axis] * velocity->steps_per_m;
        velocity->held[axis] = (fmax(-LIMIT, fmin(LIMIT, steps)) + WHOLE) - WHOLE;
    }
    velocity->started = 1;
}

/* Both versions below do the same operations on the same numbers. The new position drags the held one, which is stored
 * in rows[0] and its mirror. The window is the widest whose interior samples all lie within one count of the line
 * through its newest and its oldest. Sample i back lies within it if the slope is in [(x0 - xi - d) / i, (x0 - xi + d)
 * / i]; the intersection of these intervals shrinks as the window grows, so one pass is enough. It does not stop early
 * if the interval is empty: for an axis at rest it never is. The velocity is not that line's slope, which depends on
 * two samples only, but the mean of the window's newest third minus that of its oldest, over the time between (Bartlett
 * 1949). Running sums, sums[i] = (x0 - x1) + ... + (x0 - xi), make that cheap, and trying only some windows pays for
 * them (figures in the study `velocity`). */

/* For a window of i + 1 samples: the samples in a third, and the indices of the sums used. */
#define THIRD(i)  (((i) + 2) / 3)
#define NEAR(i)   (THIRD(i) - 1)
#define FAR(i)    ((i) - THIRD(i))
#define WEIGHT(i) (1.0 / (double)(THIRD(i) * ((i) + 1 - THIRD(i))))
/* NOLINTNEXTLINE(bugprone-integer-division): a third is a whole number of samples */
static const double weights[RING] = WINDOWS(WEIGHT);

/* Bits of the windows tried: 1, 2, 3, 4, 6, 8, 11 and 15. */
#define TRIED    0x895eu
#define TRIES(i) (TRIED >> (i) & 1u)

/* The velocities of two axes. */
static inline pair foaw_pair(const knurl_velocity_state *velocity, double (*rows)[4], int axis, pair steps) {
    pair held, best = {0.0, 0.0}, low = best - ANY_SLOPE, high = best + ANY_SLOPE;
    pair sums[RING];
    memcpy(&held, &velocity->held[axis], sizeof held);
    const pair rounded = steps + WHOLE;
    const pair least = lesser(rounded - (WHOLE + HALF_COUNT), best + LIMIT);
    const pair most = greater(rounded - (WHOLE - HALF_COUNT), best - LIMIT);
    const pair x = greater(least, lesser(most, held));
    memcpy(&rows[0][axis], &x, sizeof x);
    memcpy(&rows[RING][axis], &x, sizeof x);
    sums[0] = best;
#pragma GCC unroll 15
    for (int i = 1; i < RING; i++) {
        pair row;
        memcpy(&row, &rows[i][axis], sizeof row);
        const pair way = x - row;
        const pair slope = way * scales[i];
        const double slack = STEPS_PER_COUNT * scales[i];
        sums[i] = sums[i - 1] + way;
        if (TRIES(i)) {
            best =
                choose((slope >= low) & (slope <= high), (sums[i] - sums[FAR(i)] - sums[NEAR(i)]) * weights[i], best);
        }
        low = greater(slope - slack, low);
        high = lesser(slope + slack, high);
    }
    return best * velocity->slope_unit;
}

/* Not inlined, so that its registers are not saved if AVX is used. */
__attribute__((noinline)) static void foaw(knurl_velocity_state *velocity, double (*rows)[4], const double position[3],
                                           double out[3]) {
    const pair xy = {position[0] * velocity->steps_per_m, position[1] * velocity->steps_per_m};
    const pair z = {position[2] * velocity->steps_per_m, 0.0};
    const pair first = foaw_pair(velocity, rows, 0, xy);
    const pair second = foaw_pair(velocity, rows, 2, z);
    memcpy(velocity->held, rows[0], sizeof velocity->held);
    out[0] = first[0];
    out[1] = first[1];
    out[2] = second[0];
}

#if AVX
#define SLACK(i) (STEPS_PER_COUNT * (LCM / (i)))
static const double slacks[RING] = WINDOWS(SLACK);

/* Selects with masks, because GCC 12 turns a blend into branches. */
__attribute__((target("avx"))) static void foaw_avx(knurl_velocity_state *velocity, double (*rows)[4],
                                                    const double position[3], double out[3]) {
    const __m256d steps =
        _mm256_mul_pd(_mm256_set_pd(0.0, position[2], position[1], position[0]), _mm256_set1_pd(velocity->steps_per_m));
    const __m256d rounded = _mm256_add_pd(steps, _mm256_set1_pd(WHOLE));
    __m256d least = _mm256_sub_pd(rounded, _mm256_set1_pd(WHOLE + HALF_COUNT));
    __m256d most = _mm256_sub_pd(rounded, _mm256_set1_pd(WHOLE - HALF_COUNT));
    least = _mm256_min_pd(least, _mm256_set1_pd(LIMIT));
    most = _mm256_max_pd(most, _mm256_set1_pd(-LIMIT));
    const __m256d x = _mm256_max_pd(least, _mm256_min_pd(most, _mm256_loadu_pd(velocity->held)));
    _mm256_storeu_pd(velocity->held, x);
    _mm256_storeu_pd(rows[0], x);
    _mm256_storeu_pd(rows[RING], x);
    __m256d low = _mm256_set1_pd(-ANY_SLOPE);
    __m256d high = _mm256_set1_pd(ANY_SLOPE);
    __m256d best = _mm256_setzero_pd();
    __m256d sums[RING];
    sums[0] = _mm256_setzero_pd();
#pragma GCC unroll 15
    for (int i = 1; i < RING; i++) {
        const __m256d slack = _mm256_broadcast_sd(&slacks[i]);
        const __m256d way = _mm256_sub_pd(x, _mm256_loadu_pd(rows[i]));
        const __m256d slope = _mm256_mul_pd(way, _mm256_broadcast_sd(&scales[i]));
        sums[i] = _mm256_add_pd(sums[i - 1], way);
        if (TRIES(i)) {
            const __m256d above = _mm256_cmp_pd(slope, low, _CMP_GE_OQ);
            const __m256d fits = _mm256_and_pd(above, _mm256_cmp_pd(slope, high, _CMP_LE_OQ));
            __m256d thirds = _mm256_sub_pd(_mm256_sub_pd(sums[i], sums[FAR(i)]), sums[NEAR(i)]);
            thirds = _mm256_mul_pd(thirds, _mm256_broadcast_sd(&weights[i]));
            best = _mm256_or_pd(_mm256_and_pd(fits, thirds), _mm256_andnot_pd(fits, best));
        }
        low = _mm256_max_pd(low, _mm256_sub_pd(slope, slack));
        high = _mm256_min_pd(high, _mm256_add_pd(slope, slack));
    }
    best = _mm256_mul_pd(best, _mm256_set1_pd(velocity->slope_unit));
    _mm_storeu_pd(out, _mm256_castpd256_pd128(best));
    _mm_store_sd(out + 2, _mm256_extractf128_pd(best, 1));
}
#endif

void knurl_velocity_update(knurl_velocity *velocity, const double position[3], double out[3]) {
    KNURL_RULE(HAPTIC, velocity);
    if (!velocity || !position || !out) {
        return;
    }
    knurl_velocity_state *state = knurl_velocity_get_state(velocity);
    if (state->method == KNURL_VELOCITY_DIFFERENCE) {
        difference(state, position, out);
        return;
    }
    if (!state->started) {
        forget(state, position);
    }
    if (++state->phase >= state->stride) { /* all rings were used once */
        state->phase = 0;
        state->newest = (state->newest - 1) % RING;
    }
    double (*rows)[4] = &state->history[state->phase][state->newest];
#if AVX
    if (state->avx) {
        foaw_avx(state, rows, position, out);
        return;
    }
#endif
    foaw(state, rows, position, out);
}

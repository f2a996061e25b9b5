/* Velocity estimators: first difference, and first-order adaptive windowing (FOAW; Janabi-Sharifi, Hayward and Chen
 * 2000) on integers, which doubles hold. SPDX-License-Identifier: MIT */
#include <knurl/motion.h>

#include <math.h>
#include <string.h>

#if defined(__SSE2__) && !defined(KNURL_NO_SIMD)
#include <emmintrin.h>
#define SIMD 1
#else
#define SIMD 0
#endif

/* Positions become fixed point with this many steps a count: what sits on an encoder's counts stays exact, and what
 * does not (a device that reports millimetres from joint angles) is rounded far below its own noise. */
#define STEPS_PER_COUNT 1024

/* 16 positions are kept: the newest and the 15 before it. */
#define RING 16

/* lcm(1..15): slopes over 1 to 15 ticks, scaled by it, are integers. Samples often lie exactly one count off the line,
 * and where such ties are rounded they choose the wrong window in a third of all ticks. While positions in the window
 * differ by less than 2^34 steps (2^24 counts), slopes and slacks stay below 2^53 and no operation here rounds; beyond
 * that ties are decided to a relative 2^-53, and nothing overflows. */
#define LCM 360360.0

/* A position that was never seen: out of reach of any slope interval, and finite, so that no floating-point exception
 * is raised even where a host asks for traps. */
#define UNSEEN 1e300

knurl_result knurl_velocity_init(int32_t method, double resolution, double update_rate_hz, knurl_velocity *velocity) {
    if (method < KNURL_VELOCITY_AUTO || method > KNURL_VELOCITY_FOAW) {
        return knurl_fail(KNURL_ERROR_UNKNOWN, "velocity method: expected AUTO, DIFFERENCE or FOAW, found %d",
                          (int)method);
    }
    if (!(resolution >= 0.0 && resolution <= 1.0)) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "resolution: expected 0 to 1 m, found %g m", resolution);
    }
    if (!(update_rate_hz >= 1.0 && update_rate_hz <= 100000.0)) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "update rate: expected 1 to 100000 Hz, found %g Hz", update_rate_hz);
    }
    if (method == KNURL_VELOCITY_AUTO) {
        method = resolution > 0.0 ? KNURL_VELOCITY_FOAW : KNURL_VELOCITY_DIFFERENCE;
    }
    if (method == KNURL_VELOCITY_FOAW && !(resolution >= 1e-9)) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "resolution: FOAW expects at least 1e-9 m, found %g m", resolution);
    }
    memset(velocity, 0, sizeof *velocity);
    velocity->method = method;
    velocity->rate = update_rate_hz;
    if (method == KNURL_VELOCITY_FOAW) {
        velocity->steps_per_m = STEPS_PER_COUNT / resolution;
        velocity->slope_unit = resolution / STEPS_PER_COUNT * update_rate_hz / LCM;
    }
    return KNURL_OK;
}

void knurl_velocity_reset(knurl_velocity *velocity) {
    velocity->started = 0;
}

static void difference(knurl_velocity *velocity, const double position[3], double out[3]) {
    for (int axis = 0; axis < 3; axis++) {
        out[axis] = velocity->started ? (position[axis] - velocity->last[axis]) * velocity->rate : 0.0;
        velocity->last[axis] = position[axis];
    }
    velocity->started = 1;
}

/* Rounds half to even, by adding a number whose unit in the last place is 1; clamps (a NaN, to the limit), so that all
 * is finite. */
static double to_steps(double position, double steps_per_m) {
    const double limit = 1099511627776.0;    /* 2^40 steps */
    const double whole = 6755399441055744.0; /* 3 * 2^51 */
    double steps = position * steps_per_m;
    steps = steps < limit ? steps : limit;
    steps = steps > -limit ? steps : -limit;
    return (steps + whole) - whole;
}

/* Forgets all positions: ring and mirror. */
static void forget(knurl_velocity *velocity) {
    for (int i = 0; i < 2 * RING; i++) {
        double *row = velocity->history[i];
        row[0] = row[1] = row[2] = -UNSEEN;
        row[3] = UNSEEN;
    }
    velocity->started = 1;
}

/* Beyond every slope between positions, within every slope to UNSEEN. */
#define ANY_SLOPE 1e304

/* X(i) for each place of a table over windows; place 0 is not used. */
#define WINDOWS(X) X(1) X(1) X(2) X(3) X(4) X(5) X(6) X(7) X(8) X(9) X(10) X(11) X(12) X(13) X(14) X(15)

/* The slopes (LCM times steps per tick, three axes) of the lines through the newest and the oldest sample of the widest
 * window whose interior samples all lie within one count of that line. Sample i back lies within it when the slope is
 * in [(x0 - xi - d) / i, (x0 - xi + d) / i]; the intersection of these intervals shrinks as the window grows, so one
 * pass does. Both versions below do the same operations on the same numbers. rows[i]: minus what was seen i back. */
#if SIMD
typedef struct lane_pairs {
    __m128d scale;
    __m128d slack;
} lane_pairs;

#define WINDOW(i) {{LCM / (i), LCM / (i)}, {STEPS_PER_COUNT * (LCM / (i)), STEPS_PER_COUNT * (LCM / (i))}},
static const lane_pairs windows[RING] = {WINDOWS(WINDOW)};
#undef WINDOW

static __m128d choose(__m128d mask, __m128d yes, __m128d no) {
    return _mm_or_pd(_mm_and_pd(mask, yes), _mm_andnot_pd(mask, no));
}

/* x and y side by side; z with -z, whose lower bound is minus z's upper bound: one maximum keeps both. */
static void widest_slopes(const double (*rows)[4], double slopes[4]) {
    const __m128d sign = _mm_set1_pd(-0.0);
    const __m128d xy = _mm_xor_pd(_mm_loadu_pd(rows[0]), sign);
    const __m128d zz = _mm_xor_pd(_mm_loadu_pd(rows[0] + 2), sign);
    __m128d low = _mm_set1_pd(-ANY_SLOPE);
    __m128d high = _mm_set1_pd(ANY_SLOPE);
    __m128d low_zz = low;
    __m128d best_xy = _mm_setzero_pd();
    __m128d best_zz = _mm_setzero_pd();
    for (int i = 1; i < RING; i++) {
        const __m128d scale = windows[i].scale;
        const __m128d slack = windows[i].slack;
        const __m128d slope = _mm_mul_pd(_mm_add_pd(_mm_loadu_pd(rows[i]), xy), scale);
        const __m128d slope_zz = _mm_mul_pd(_mm_add_pd(_mm_loadu_pd(rows[i] + 2), zz), scale);
        const __m128d within = _mm_cmpge_pd(slope_zz, low_zz);
        const __m128d fits_zz = _mm_and_pd(within, _mm_shuffle_pd(within, within, 1));
        best_xy = choose(_mm_and_pd(_mm_cmpge_pd(slope, low), _mm_cmple_pd(slope, high)), slope, best_xy);
        best_zz = choose(fits_zz, slope_zz, best_zz);
        low = _mm_max_pd(low, _mm_sub_pd(slope, slack));
        high = _mm_min_pd(high, _mm_add_pd(slope, slack));
        low_zz = _mm_max_pd(low_zz, _mm_sub_pd(slope_zz, slack));
    }
    _mm_storeu_pd(slopes, best_xy);
    _mm_storeu_pd(slopes + 2, best_zz);
}
#else
#define WINDOW(i) LCM / (i),
static const double scale[RING] = {WINDOWS(WINDOW)};
#undef WINDOW

/* Four lanes and no branch, so that compilers may vectorise it; the fourth is not used. */
static void widest_slopes(const double (*rows)[4], double slopes[4]) {
    double low[4] = {-ANY_SLOPE, -ANY_SLOPE, -ANY_SLOPE, -ANY_SLOPE};
    double high[4] = {ANY_SLOPE, ANY_SLOPE, ANY_SLOPE, ANY_SLOPE};
    double best[4] = {0.0, 0.0, 0.0, 0.0};
    for (int i = 1; i < RING; i++) {
        const double slack = STEPS_PER_COUNT * scale[i];
        for (int axis = 0; axis < 4; axis++) {
            const double slope = (rows[i][axis] - rows[0][axis]) * scale[i];
            const int fits = (slope >= low[axis]) & (slope <= high[axis]);
            best[axis] = fits ? slope : best[axis];
            low[axis] = slope - slack > low[axis] ? slope - slack : low[axis];
            high[axis] = slope + slack < high[axis] ? slope + slack : high[axis];
        }
    }
    memcpy(slopes, best, sizeof best);
}
#endif

void knurl_velocity_update(knurl_velocity *velocity, const double position[3], double out[3]) {
    if (velocity->method == KNURL_VELOCITY_DIFFERENCE) {
        difference(velocity, position, out);
        return;
    }
    if (!velocity->started) {
        forget(velocity);
    }
    velocity->newest = (velocity->newest - 1) % RING;
    double (*rows)[4] = &velocity->history[velocity->newest];
    const double x = to_steps(position[0], velocity->steps_per_m);
    const double y = to_steps(position[1], velocity->steps_per_m);
    const double z = to_steps(position[2], velocity->steps_per_m);
    for (int copy = 0; copy <= RING; copy += RING) {
        rows[copy][0] = -x;
        rows[copy][1] = -y;
        rows[copy][2] = -z;
        rows[copy][3] = z;
    }
    double slopes[4];
    widest_slopes((const double (*)[4])rows, slopes);
    for (int axis = 0; axis < 3; axis++) {
        out[axis] = slopes[axis] * velocity->slope_unit;
    }
}

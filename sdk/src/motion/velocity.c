/* Velocity estimators: first difference, and first-order adaptive windowing (FOAW; Janabi-Sharifi, Hayward and Chen
 * 2000) on integers. SPDX-License-Identifier: MIT */
#include <knurl/motion.h>

#include <math.h>
#include <string.h>

/* Positions become fixed point with this many steps a count: what sits on an encoder's counts stays exact, and what
 * does not (a device that reports millimetres from joint angles) is rounded far below its own noise. */
#define STEPS_PER_COUNT 1024

/* 16 positions are kept: the newest and the 15 before it. */
#define RING 16

/* lcm(1..15): slopes over 1 to 15 ticks, scaled by it, are integers. Samples often lie exactly one count off the line,
 * and in floating point such ties choose the wrong window in a third of all ticks. */
#define LCM 360360

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
        velocity->m_per_step = resolution / STEPS_PER_COUNT;
    }
    return KNURL_OK;
}

void knurl_velocity_reset(knurl_velocity *velocity) {
    velocity->count = 0;
}

static void difference(knurl_velocity *velocity, const double position[3], double out[3]) {
    for (int axis = 0; axis < 3; axis++) {
        out[axis] = velocity->count > 0 ? (position[axis] - velocity->last[axis]) * velocity->rate : 0.0;
        velocity->last[axis] = position[axis];
    }
    velocity->count = 1;
}

/* Rounds half away from zero, without a call into libm; clamps so that no product below can overflow. */
static int64_t to_steps(double position, double steps_per_m) {
    const double limit = 1099511627776.0; /* 2^40 steps; times 2 LCM it stays below 2^61 */
    const double steps = position * steps_per_m;
    if (!(steps < limit)) {
        return (int64_t)limit;
    }
    return steps < -limit ? -(int64_t)limit : (int64_t)(steps + (steps < 0.0 ? -0.5 : 0.5));
}

/* The slope, in steps per tick, of the line through the newest and the oldest sample of the widest window whose
 * interior samples all lie within one count of that line. Sample i back lies within it when the slope is in
 * [(x0 - xi - d) / i, (x0 - xi + d) / i]; the intersection of these intervals grows with the window, so one pass does.
 */
static double widest_slope(const int64_t *ring, uint32_t newest, uint32_t count) {
    static const int64_t scale[RING] = {0,       LCM / 1, LCM / 2,  LCM / 3,  LCM / 4,  LCM / 5,  LCM / 6,  LCM / 7,
                                        LCM / 8, LCM / 9, LCM / 10, LCM / 11, LCM / 12, LCM / 13, LCM / 14, LCM / 15};
    const int64_t x0 = ring[newest];
    int64_t low = INT64_MIN;
    int64_t high = INT64_MAX;
    int64_t best = 0;
    for (uint32_t i = 1; i < count; i++) {
        const int64_t slope = (x0 - ring[(newest - i) % RING]) * scale[i];
        const int64_t slack = STEPS_PER_COUNT * scale[i];
        best = slope >= low && slope <= high ? slope : best;
        low = slope - slack > low ? slope - slack : low;
        high = slope + slack < high ? slope + slack : high;
    }
    return (double)best / LCM;
}

void knurl_velocity_update(knurl_velocity *velocity, const double position[3], double out[3]) {
    if (velocity->method == KNURL_VELOCITY_DIFFERENCE) {
        difference(velocity, position, out);
        return;
    }
    velocity->newest = (velocity->newest + 1) % RING;
    velocity->count += velocity->count < RING;
    for (int axis = 0; axis < 3; axis++) {
        velocity->history[axis][velocity->newest] = to_steps(position[axis], velocity->steps_per_m);
        out[axis] = widest_slope(velocity->history[axis], velocity->newest, velocity->count) * velocity->m_per_step *
                    velocity->rate;
    }
}

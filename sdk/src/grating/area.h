/* The method AREA, one tick at a time: the mean of the square wave over the distance since the last tick, as an
 * area-sampled picture averages over a pixel. With P the phase in cycles, d the cycles of this tick and I the integral
 * of the unit square wave: H = A (I(P + d) - I(P)) / (d sinc d), whose fundamental is S1's at any d. The usual tick is
 * inlined into knurl_grating_step(), because a call would take a tenth longer. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_AREA_H
#define KNURL_SRC_AREA_H

#include <knurl/grating.h>

#include "grating/phase.h"

#include <math.h>

/* Cycles a tick from which on LOCKED's events play, and below which they end: near f_h/2 the level of the means varies
 * with their phase. Up to 0.45 the level of steady scans is constant (`knurl study area`: it varies by 0.01 at 0.45,
 * 0.02 at 0.46, 0.12 at 0.47). The gap is over ten times the noise of FOAW's velocity on a Touch. */
#define KNURL_AREA_EVENTS_FROM  0.46
#define KNURL_AREA_EVENTS_UNTIL 0.44

/* cycles * sinc(d), with sinc(d) = sin(pi d)/(pi d) for |d| <= 1/2 to 2e-11: the polynomial in d^2 through Chebyshev's
 * points of [0, 1/4], as the product of its zero (near 1, where sinc has one) and two pairs of complex ones. Three
 * short products have less latency and fewer operations than a sum of six terms. */
static inline double knurl_area_droop(double cycles, double d) {
    const double x = d * d;
    const double u = x - 3.365848657123835;
    const double v = x - 1.971283354845006;
    const double pairs = (u * u + 1.2880499846963516) * (v * v + 31.545598934987193);
    return cycles * 0.0022372048506589257 * (0.9998810763148457 - x) * pairs;
}

/* The integral of the square wave from the start of a cycle, a triangle of height 1/2: how far the phase is from a
 * whole number. Exact to 2^51 cycles, as knurl_whole_cycles(). */
static inline double knurl_area_integral(double phase) {
    return fabs(phase - ((phase + KNURL_WHOLE) - KNURL_WHOLE));
}

/* The mean from one phase to another one, d cycles away (-1/2 to 1/2), for a square wave of height A; at most pi/2 A.
 */
static inline double knurl_area_mean(double amplitude, double from, double to, double d) {
    return amplitude * (knurl_area_integral(to) - knurl_area_integral(from)) / knurl_area_droop(to - from, d);
}

/* The same where the two are one. */
static inline double knurl_area_point(double amplitude, double phase) {
    return knurl_first_half(phase) ? amplitude : -amplitude;
}

/* The height of any tick: knurl_area_step() without its short cut. */
double knurl_area_step_any(const knurl_grating *grating, knurl_grating_state *state, const double position[2],
                           const double velocity[2], double frequency, knurl_grating_output *output) KNURL_NONBLOCKING;

/* The height of this tick. frequency: Hz, of this motion. position: null where there is none; the distance is then that
 * of the velocity. Sets output->above_nyquist where it jumps. */
static inline double knurl_area_step(const knurl_grating *grating, knurl_grating_state *state, const double position[2],
                                     const double velocity[2], double frequency, knurl_grating_output *output) {
    const double *fs = grating->spatial_frequency;
    if (position && !(fs[1] > 0.0) && !state->playing &&
        frequency < KNURL_AREA_EVENTS_UNTIL * grating->update_rate_hz) { /* ridges one way, and no event */
        const double distance = position[0] - state->held;
        const double from = fs[0] * state->held + 0.25;
        const double to = fs[0] * position[0] + 0.25;
        if (state->direction * (to - from) > 0.0 && fabs(fs[0] * distance) < 0.5) {
            state->held = position[0];
            state->moving = 0;
            state->next_tick = 0;
            return knurl_area_mean(grating->amplitude, from, to, fs[0] * distance);
        }
        if (distance == 0.0 && state->direction) {
            state->moving = 0;
            state->next_tick = 0;
            return knurl_area_point(grating->amplitude, to);
        }
    }
    return knurl_area_step_any(grating, state, position, velocity, frequency, output);
}

#endif

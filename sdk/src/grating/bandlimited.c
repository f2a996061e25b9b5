/* The method BANDLIMITED: of the square wave's harmonics only those that the update rate can carry, at the phase of the
 * position. No events, and no aliasing below f_h/2. At low speed it is the mean of the square wave over the
 * distance of the tick, which is as clean there, has sharper edges and swings to A only.
 * SPDX-License-Identifier: MIT */
#include "grating/method.h"

#include "base/base.h"
#include "grating/follow.h"

#include <math.h>

/* With d cycles a tick, harmonic n fades out from n d = 0.38 to 0.5, at which it would fold back. */
#define FADE_FROM  0.38
#define FADE_UNTIL 0.5

/* Cycles a tick: below the first the mean is played, from the second on harmonics; no more than three of them are below
 * f_h/2 there. Between the two, both are mixed. */
#define MEAN_UNTIL     0.06
#define HARMONICS_FROM (1.0 / 12.0)

/* A: above f_h/2 the sign changes every tick, at about the level that is felt just below: 4/pi sinc(0.454) of a sine is
 * as much as a square wave of 0.69. */
#define ALTERNATING 0.7

#define FUNDAMENTAL 1.2732395447351628 /* 4/pi */

/* On a grid: the other axis takes over if it crosses this many times as many ridges. */
#define TAKE_OVER 1.1

/* cos(2 pi phase) to 1.3e-6: sin(2 pi t) by the odd polynomial through Chebyshev's points of [-1/4, 1/4]. libm's
 * differs from library to library. */
static inline double cosine(double phase) {
    const double t = 0.25 - fabs(phase - knurl_nearest_cycle(phase));
    const double x = t * t;
    return t * ((6.283180513495809 - 41.33924613089626 * x) + x * x * (81.40800691799149 - 71.60768010669648 * x));
}

/* 0 at from, 1 at to, with no corner at either. */
static double fade(double x, double from, double to) {
    const double u = (x - from) * (1.0 / (to - from));
    const double z = u > 0.0 ? u < 1.0 ? u : 1.0 : 0.0;
    return z * z * (3.0 - 2.0 * z);
}

/* The first, third and fifth harmonic: with c = cos a, cos 3a = c (4 c^2 - 3) and cos 5a = c (16 c^4 - 20 c^2 + 5).
 * Sorted by powers of c, so that the factors of d alone are ready before c. */
static inline double harmonics(double amplitude, double phase, double d) {
    const double first = FUNDAMENTAL * amplitude;
    const double c = cosine(phase);
    if (3.0 * d >= FADE_UNTIL) {
        return first * c;
    }
    const double third = first * fade(3.0 * d, FADE_UNTIL, FADE_FROM);
    if (5.0 * d >= FADE_UNTIL) {
        return c * (first + third - 4.0 / 3.0 * third * (c * c));
    }
    const double fifth = first * fade(5.0 * d, FADE_UNTIL, FADE_FROM);
    const double of_3 = -4.0 / 3.0 * third - 4.0 * fifth;
    const double x = c * c;
    return c * ((first + third + fifth) + x * (of_3 + x * (16.0 / 5.0 * fifth)));
}

/* The integral of the square wave: a triangle, by how far the phase is from the middle of a trough or a crest. */
static double integral(double phase) {
    const double p = phase + 0.25;
    return fabs(p - knurl_nearest_cycle(p));
}

/* The mean of the square wave from one phase to another, in A. Its value if they are too close for a difference of
 * doubles, or too far apart, which only a jump is. */
static double mean(double from, double to) {
    const double way = to - from;
    if (!(fabs(way) < 0.5) || fabs(way) < 1e-6) {
        return knurl_first_half(to + 0.25) ? 1.0 : -1.0;
    }
    const double height = (integral(to) - integral(from)) / way;
    return height > 1.0 ? 1.0 : height > -1.0 ? height : -1.0;
}

/* On a grid: the axis that crosses the most ridges (Eq. 12). If the other one takes over, the phase continues from its
 * present value in its present direction: a cosine is the same backwards. Not inlined: every grating would save the
 * registers that it needs. */
__attribute__((noinline)) static void choose_axis(const knurl_grating *g, knurl_grating_state *s,
                                                  const double velocity[2]) {
    const double *fs = g->spatial_frequency;
    const int32_t now = s->axis, other = 1 - s->axis;
    const double margin = s->direction ? TAKE_OVER : 1.0; /* no margin at the first tick */
    if (!(fs[other] * fabs(velocity[other]) > margin * fs[now] * fabs(velocity[now]))) {
        return;
    }
    s->axis = other;
    if (s->direction) {
        s->phase = (velocity[other] < 0.0) == (s->direction < 0) ? s->phase : -s->phase;
        s->offset = s->phase - fs[other] * s->tracked[other];
    }
}

double knurl_bandlimited_height(const knurl_grating *grating, knurl_grating_state *state, knurl_along position,
                                knurl_along velocity, double period, int32_t has_position,
                                knurl_grating_output *output) {
    const double d = output->temporal_frequency * period;
    const double *fs = grating->spatial_frequency;
    int32_t axis = fs[0] > 0.0 ? 0 : 1;
    if (KNURL_UNLIKELY(fs[0] > 0.0 && fs[1] > 0.0)) {
        const double both[2] = {velocity.x, velocity.y};
        choose_axis(grating, state, both);
        axis = state->axis;
    }
    const knurl_along at = knurl_follow(state, position, velocity, period, has_position);
    const double speed = axis ? velocity.y : velocity.x;
    const double phase = fs[axis] * (axis ? at.y : at.x) + state->offset;
    const double from = state->direction == 0 ? phase : state->phase;
    state->direction = speed < 0.0 ? -1 : 1;
    state->phase = phase;
    const double amplitude = grating->amplitude;
    double height;
    if (d <= MEAN_UNTIL) {
        height = amplitude * mean(from, phase);
    } else if (d < FADE_UNTIL) {
        height = harmonics(amplitude, phase, d);
        if (d < HARMONICS_FROM) {
            const double flat = amplitude * mean(from, phase);
            height = flat + fade(d, MEAN_UNTIL, HARMONICS_FROM) * (height - flat);
        }
    } else {
        height = state->sign > 0 ? -ALTERNATING * amplitude : ALTERNATING * amplitude;
    }
    state->event_count += (height > 0.0) & (state->sign <= 0); /* no branch to mispredict */
    output->event = state->event_count - 1;
    return height;
}

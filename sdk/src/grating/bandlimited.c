/* The method BANDLIMITED: of the square wave's harmonics only those that the update rate can carry, at the phase of the
 * tracked position. No events, and no aliasing below f_h/2. At low speed it is the mean of the square wave over the
 * distance of the tick, which is as clean there, has sharper edges and swings to A only.
 * SPDX-License-Identifier: MIT */
#include "grating/bandlimited.h"

#include "base/finite.h"
#include "grating/phase.h"

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

/* m: the largest distance that a velocity makes in one tick. */
#define FARTHEST 1e6

/* On a grid: the other axis takes over if it crosses this many times as many ridges. */
#define TAKE_OVER 1.1

/* cos(2 pi phase) to 7e-9: sin(2 pi t) by the odd polynomial through Chebyshev's points of [-1/4, 1/4]. libm's differs
 * from library to library. */
static double cosine(double phase) {
    const double t = 0.25 - fabs(phase - knurl_nearest_cycle(phase));
    const double x = t * t;
    const double low = 6.283185280154406 - 41.34168061334649 * x;
    const double high = 81.60247636892437 + x * (39.759827085616394 * x - 76.58117264428655);
    return t * (low + x * x * high);
}

/* 0 at from, 1 at to, with no corner at either. */
static double fade(double x, double from, double to) {
    const double u = (x - from) / (to - from);
    const double z = u > 0.0 ? u < 1.0 ? u : 1.0 : 0.0;
    return z * z * (3.0 - 2.0 * z);
}

/* The first, third and fifth harmonic, in A; by cos 3a = c (4 c^2 - 3) and cos 5a = c (16 c^4 - 20 c^2 + 5). */
static double harmonics(double phase, double d) {
    const double c = cosine(phase);
    double sum = c;
    if (3.0 * d < FADE_UNTIL) {
        const double x = c * c;
        const double third = c * (4.0 * x - 3.0);
        const double fifth = c * (x * (16.0 * x - 20.0) + 5.0);
        sum -= fade(3.0 * d, FADE_UNTIL, FADE_FROM) * (1.0 / 3.0) * third;
        sum += fade(5.0 * d, FADE_UNTIL, FADE_FROM) * (1.0 / 5.0) * fifth;
    }
    return FUNDAMENTAL * sum;
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

/* m, moved in one tick; 0 if the velocity is not finite. */
static double distance(double velocity, double rate) {
    const double moved = velocity / rate;
    return fabs(moved) < FARTHEST ? moved : 0.0;
}

/* Moves a tracked position by one tick's velocity, and no farther from the measured one than half a count, which is
 * where the true one is. So it is smooth in steady motion, never late and never more than half a count off, and it
 * stands still if an encoder flickers between two counts, because FOAW's velocity is 0 there. A second-order observer
 * at 12 Hz within the same bound was worse in every figure, and made half cycles of a flicker (`knurl study tradeoff`).
 */
static double track(double tracked, double moved, double measured, double count) {
    const double at = tracked + moved;
    const double low = measured - 0.5 * count;
    const double high = measured + 0.5 * count;
    return at > low ? at < high ? at : high : low;
}

/* On a grid: the axis that crosses the most ridges (Eq. 12). If the other one takes over, the phase goes on from where
 * it is, in the direction in which it went: a cosine is the same backwards. */
static void choose_axis(const knurl_grating *g, knurl_grating_state *s, const double velocity[2]) {
    const double *fs = g->spatial_frequency;
    const int32_t now = s->axis, other = 1 - s->axis;
    const double margin = s->direction ? TAKE_OVER : 1.0; /* at the first tick none */
    if (!(fs[other] * fabs(velocity[other]) > margin * fs[now] * fabs(velocity[now]))) {
        return;
    }
    s->axis = other;
    if (s->direction) {
        s->phase = (velocity[other] < 0.0) == (s->direction < 0) ? s->phase : -s->phase;
        s->offset = s->phase - fs[other] * s->tracked[other];
    }
}

/* Moves on by one tick. Returns the phase before it; state->phase is the one after it. */
static double move(const knurl_grating *g, knurl_grating_state *s, const knurl_grating_input *input) {
    const double *fs = g->spatial_frequency;
    choose_axis(g, s, input->velocity);
    const double before = s->phase, speed = input->velocity[s->axis];
    const int begins = s->direction == 0;
    for (int i = 0; i < 2; i++) {
        const double moved = distance(input->velocity[i], g->update_rate_hz);
        const double measured = input->position[i];
        s->tracked[i] = !input->has_position ? s->tracked[i] + moved
                        : !begins            ? track(s->tracked[i], moved, measured, g->resolution)
                                             : measured;
    }
    s->phase = fs[s->axis] * s->tracked[s->axis] + s->offset;
    s->direction = speed < 0.0 ? -1 : speed > 0.0 || begins ? 1 : s->direction;
    return begins ? s->phase : before;
}

double knurl_bandlimited_height(const knurl_grating *grating, knurl_grating_state *state,
                                const knurl_grating_input *input, knurl_grating_output *output) {
    const double d = output->temporal_frequency / grating->update_rate_hz;
    const double from = move(grating, state, input);
    double height;
    if (!(d < FADE_UNTIL)) {
        height = state->sign > 0 ? -ALTERNATING : ALTERNATING;
    } else if (d >= HARMONICS_FROM) {
        height = harmonics(state->phase, d);
    } else {
        height = mean(from, state->phase);
        if (d > MEAN_UNTIL) {
            height += fade(d, MEAN_UNTIL, HARMONICS_FROM) * (harmonics(state->phase, d) - height);
        }
    }
    height *= grating->amplitude;
    state->event_count += (height > 0.0) & (state->sign <= 0); /* no branch to mispredict */
    output->event = state->event_count - 1;
    return height;
}

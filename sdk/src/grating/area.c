/* The method AREA: the mean of the square wave over the distance since the last tick, as an area-sampled picture
 * averages over a pixel. With P the phase in cycles in the direction of motion, d the cycles of this tick and I the
 * integral of the unit square wave: H = A (I(P + d) - I(P)) / (d sinc d), whose fundamental is S1's at any d. Near
 * f_h/2, where the level of the samples varies with their phase, LOCKED's events take over.
 * SPDX-License-Identifier: MIT */
#include "grating/area.h"

#include "grating/locked.h"
#include "grating/phase.h"

#include <math.h>

/* Cycles a tick from which on events play, and below which they end. Up to 0.45 the level of steady scans is even
 * (knurl study area: it wavers by 0.01 at 0.45, 0.02 at 0.46, 0.12 at 0.47); the gap is over ten times what FOAW's
 * velocity flickers by on a Touch. */
#define EVENTS_FROM  0.46
#define EVENTS_UNTIL 0.44

/* m in one tick, where there is no position but a velocity. */
#define FARTHEST 1e6

/* On a grid, how much faster cycles must go by along the other axis for it to take over. */
#define TAKE_OVER 1.1

/* Positions a quantum apart are so to within rounding. */
#define ROUNDED 1.000001

/* sin(pi d)/(pi d) for d in [0, 1/2], to 3e-11: interpolated in d^2 at Chebyshev's points of [0, 1/4]. Summed as a
 * tree, which waits less for its products. */
static double sinc(double d) {
    const double x = d * d;
    const double x2 = x * x;
    const double low =
        0.9999999999829696 - x * 1.6449340619381498 + x2 * (0.8117421958038414 - x * 0.19074789888155266);
    return low + x2 * x2 * (0.026117454045581086 - x * 0.0022372048506589257);
}

/* The integral of the square wave from the begin of a cycle, a triangle up to 1/2: how far the phase is from a whole
 * number. Exact to 2^51 cycles, as knurl_whole_cycles(). */
static double integral(double phase) {
    return fabs(phase - ((phase + KNURL_WHOLE) - KNURL_WHOLE));
}

/* The mean from one phase to another, at most half a cycle away, for a square wave of height A; at most pi/2 A. */
static double mean(double amplitude, double from, double to, double droop) {
    const double way = to - from;
    if (way == 0.0) {
        return knurl_first_half(to) ? amplitude : -amplitude;
    }
    return amplitude * (integral(to) - integral(from)) / (way * droop);
}

/* On a grid: cycles are Eq. 12's, those of the axis along which the most go by. The phase goes on where the other axis
 * takes over, counted along its coordinate from there. */
static int choose_axis(const knurl_grating *g, knurl_grating_state *s, const double velocity[2]) {
    const double *fs = g->spatial_frequency;
    int along = s->axis;
    if (!(fs[0] > 0.0 && fs[1] > 0.0)) {
        return fs[0] > 0.0 ? 0 : 1;
    }
    const double cycles[2] = {fs[0] * fabs(velocity[0]), fs[1] * fabs(velocity[1])};
    if (s->direction == 0) {
        along = cycles[1] > cycles[0];
    } else if (cycles[1 - along] > TAKE_OVER * cycles[along]) {
        const double place = s->across;
        along = 1 - along;
        s->across = s->held;
        s->held = place;
        s->direction = velocity[along] < 0.0 ? -1 : 1;
    }
    s->axis = along;
    return along;
}

/* Goes on along an axis and returns the way, m, >= 0. A position that comes back by no more than a quantum has not
 * moved. Sets *turned where it goes back. */
static double follow(knurl_grating_state *s, double place, double quantum, int *turned) {
    const double ahead = s->direction * (place - s->held);
    if (ahead > 0.0) {
        s->held = place;
        return ahead;
    }
    if (ahead < -ROUNDED * quantum) {
        s->direction = -s->direction;
        s->held = place;
        *turned = 1;
        return -ahead;
    }
    return 0.0;
}

/* The way along an axis by the velocity, m. What is no number is none, so that the sum stays one. */
static double coast(const knurl_grating *g, double velocity) {
    const double way = velocity / g->update_rate_hz;
    return fabs(way) < FARTHEST ? way : 0.0;
}

/* The way of a tick, between two phases in cycles: on a line those of the place, on a grid those in the direction of
 * motion. */
typedef struct way {
    double from, to;
    double length; /* >= 0, or no number */
} way;

/* Moves on by one tick; s->phase gets to where it is, in the direction of motion. */
static way move(const knurl_grating *g, knurl_grating_state *s, const double position[2], const double velocity[2]) {
    const double *fs = g->spatial_frequency;
    const int along = choose_axis(g, s, velocity);
    const int is_grid = fs[1 - along] > 0.0;
    const int begins = s->direction == 0;
    int turned = 0;
    double place = position ? position[along] : s->held + coast(g, velocity[along]);
    if (begins) { /* no way yet */
        place = position ? place : 0.0;
        s->direction = velocity[along] < 0.0 ? -1 : 1;
        s->held = place;
    }
    const double from = fs[along] * s->held + 0.25;
    const double length = fs[along] * follow(s, place, position ? g->resolution : 0.0, &turned);
    const double to = fs[along] * s->held + 0.25; /* forwards it rises a quarter cycle before a crest */
    if (!is_grid || begins) {
        s->phase = s->direction < 0 ? 0.5 - to : to;
    } else {
        s->phase = (turned ? 0.5 - s->phase : s->phase) + (length < 1.0 ? length : 0.0);
    }
    if (is_grid) {
        s->across = position ? position[1 - along] : s->across + coast(g, velocity[1 - along]);
        return (way){s->phase - (length < 1.0 ? length : 0.0), s->phase, length};
    }
    return (way){from, to, length};
}

/* One tick of any kind. A way of a cycle or more is none that a tick could play. Not inlined: what it keeps on the
 * stack would be kept in every tick. */
__attribute__((noinline)) static double step(const knurl_grating *g, knurl_grating_state *s, const double position[2],
                                             const double velocity[2], double frequency, knurl_grating_output *output) {
    const double rate = g->update_rate_hz;
    const way w = move(g, s, position, velocity);
    const double before = s->phase - (w.length < 1.0 ? w.length : 0.0); /* as late as means, which are of the way */
    const double lowest = (s->moving ? EVENTS_UNTIL : EVENTS_FROM) * rate;
    double height;
    output->saturated |= !(w.length < 1.0);
    /* events begin where the way is as fast as the velocity says: an estimate is far off for a while after a jump */
    if (((w.length > 0.5 * EVENTS_UNTIL && w.length < 1.0) || s->moving || s->playing) &&
        knurl_locked_play(g, s, before, before - frequency / rate, frequency, lowest, &height)) {
        return height;
    }
    s->next_tick = 0;
    return w.length < 1.0 ? mean(g->amplitude, w.from, w.to, sinc(w.length < 0.5 ? w.length : 0.5)) : 0.0;
}

double knurl_area_step(const knurl_grating *grating, knurl_grating_state *state, const double position[2],
                       const double velocity[2], double frequency, knurl_grating_output *output) {
    const double *fs = grating->spatial_frequency;
    if (position && !(fs[1] > 0.0) && !state->playing &&
        frequency < EVENTS_UNTIL * grating->update_rate_hz) { /* what most ticks are, with little to be looked at */
        const double from = fs[0] * state->held + 0.25;
        const double to = fs[0] * position[0] + 0.25;
        const double d = state->direction * (to - from);
        if (d >= 0.0 && d < 0.5 && state->direction) {
            state->held = position[0];
            state->moving = 0;
            state->next_tick = 0;
            return mean(grating->amplitude, from, to, sinc(to - from));
        }
    }
    return step(grating, state, position, velocity, frequency, output);
}

/* The method AREA: the distance of each tick, on lines and on grids, and LOCKED's events near f_h/2.
 * SPDX-License-Identifier: MIT */
#include "grating/area.h"

#include "grating/locked.h"

/* The largest step that a velocity makes in one tick, m. */
#define FARTHEST 1e6

/* On a grid: the other axis takes over when its frequency is this many times higher. */
#define TAKE_OVER 1.1

/* Two positions one quantum apart differ by a quantum times at most this. */
#define ROUNDED 1.000001

/* On a grid: counts cycles along the axis with the higher frequency (Eq. 12). When the other axis takes over, the phase
 * continues and is counted along its coordinate from there. */
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

/* Moves to a new position along an axis and returns the distance, m, >= 0. A position that comes back by at most a
 * quantum has not moved. Sets *turned when the direction changes. */
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

/* The distance that the velocity makes in one tick along an axis, m; 0 where it is not finite. */
static double coast(const knurl_grating *g, double velocity) {
    const double distance = velocity / g->update_rate_hz;
    return fabs(distance) < FARTHEST ? distance : 0.0;
}

/* What a tick passes, from one phase to another, cycles: on a line the position's, on a grid those in the direction of
 * motion. */
typedef struct span {
    double from, to;
    double length; /* >= 0, or no number */
} span;

/* Moves on by one tick; s->phase gets to where it is, in the direction of motion. */
static span move(const knurl_grating *g, knurl_grating_state *s, const double position[2], const double velocity[2]) {
    const double *fs = g->spatial_frequency;
    const int along = choose_axis(g, s, velocity);
    const int is_grid = fs[1 - along] > 0.0;
    const int begins = s->direction == 0;
    int turned = 0;
    double place = position ? position[along] : s->held + coast(g, velocity[along]);
    if (begins) { /* nothing is passed yet */
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
        return (span){s->phase - (length < 1.0 ? length : 0.0), s->phase, length};
    }
    return (span){from, to, length};
}

/* One tick cannot render a distance of a cycle or more: the height is 0. */
double knurl_area_step_any(const knurl_grating *grating, knurl_grating_state *state, const double position[2],
                           const double velocity[2], double frequency, knurl_grating_output *output) {
    const double rate = grating->update_rate_hz;
    const span passed = move(grating, state, position, velocity);
    const double before =
        state->phase - (passed.length < 1.0 ? passed.length : 0.0); /* as late as a mean over the span */
    const double lowest = (state->moving ? KNURL_AREA_EVENTS_UNTIL : KNURL_AREA_EVENTS_FROM) * rate;
    double height;
    output->above_nyquist |= !(passed.length < 1.0);
    /* only where distance and velocity agree: after a jump the estimated velocity is wrong for some ticks */
    if (((passed.length > 0.5 * KNURL_AREA_EVENTS_UNTIL && passed.length < 1.0) || state->moving || state->playing) &&
        knurl_locked_play(grating, state, before, before - frequency / rate, frequency, lowest, &height)) {
        return height;
    }
    state->next_tick = 0;
    if (!(passed.length < 1.0)) {
        return 0.0;
    }
    return passed.from == passed.to
               ? knurl_area_point(grating->amplitude, passed.to)
               : knurl_area_mean(grating->amplitude, passed.from, passed.to, passed.length < 0.5 ? passed.length : 0.5);
}

/* The method LOCKED: balanced events whose lengths keep step with the surface above a crossover frequency, the height
 * that the position asks for below it. Phases count cycles in the direction of motion; a cycle begins at a ridge's
 * rising edge (Eq. 11's, one quarter before a crest of its cosine). SPDX-License-Identifier: MIT */
#include "grating/locked.h"

#include "vibration/event.h"

#include <math.h>

/* The haptic Weber fraction for frequencies that the paper uses (figure 3). */
#define JND 0.38

/* Follows the position on a grating with ridges one way: it has moved when it has gone on, or come back by more than a
 * quantum (so an encoder that flickers on a ridge's edge does not toggle the height). */
static double follow(const knurl_grating *g, knurl_grating_state *s, double place, double velocity) {
    if (s->direction == 0) {
        s->direction = velocity < 0.0 ? -1 : 1;
        s->held = place;
    }
    const double ahead = s->direction * (place - s->held);
    if (ahead < -g->resolution) {
        s->direction = -s->direction;
        s->held = place;
    } else if (ahead > 0.0) {
        s->held = place;
    }
    return s->held;
}

/* Cycles crossed, in the direction of motion. */
static double find_phase(const knurl_grating *g, knurl_grating_state *s, const double position[2],
                         const double velocity[2], double frequency) {
    const double *fs = g->spatial_frequency;
    const int along = fs[0] > 0.0 ? 0 : 1;
    if (fs[1 - along] > 0.0 || !position) { /* Eq. 12's cycles are a matter of the way, not of the place */
        s->direction = 1;
        return s->phase + frequency / g->update_rate_hz;
    }
    const double cycles = fs[along] * follow(g, s, position[along], velocity[along]);
    /* forwards the height rises a quarter cycle before each crest, backwards a quarter cycle after it */
    return s->direction * cycles + 0.25;
}

/* The length of the next event, which begins at phase `late` of its cycle: what brings the end of the event to the end
 * of the cycle, as far as the hand does not notice; or the whole numbers either side of the period. */
static double choose_length(double period, double late) {
    const double least = fmin(floor(period), ceil(period / (1.0 + JND)));
    const double most = fmax(ceil(period), floor(period * (1.0 + JND)));
    const double wanted = floor(period * (1.0 - late) + 0.5);
    return fmax(2.0, fmin(fmax(wanted, least), most));
}

/* Whether an event begins at this tick; then s->played is where its cycle begins. */
static int event_begins(const knurl_grating *g, knurl_grating_state *s, double before, double frequency) {
    const double crossover = g->crossover_hz > 0.0 ? g->crossover_hz : KNURL_LOCKED_CROSSOVER_HZ;
    if (frequency < crossover) {
        s->moving = 0;
        return 0;
    }
    const double whole = floor(s->phase);
    if (s->moving) {
        const double debt = s->phase - s->played;
        if (frequency > 0.5 * g->update_rate_hz) {
            s->played = s->phase;
        } else if (!(fabs(debt) < 1.0)) { /* whole cycles that were missed, or never were, are not made up for */
            s->played += floor(debt + 0.5);
        }
        return 1;
    }
    const double half_tick = 0.5 * frequency / g->update_rate_hz;
    if (s->phase - whole > 1.0 - half_tick) {
        s->played = whole + 1.0;
    } else if (s->phase - whole <= half_tick || (floor(before) < whole && s->phase - whole < 0.5)) {
        s->played = whole;
    } else {
        return 0; /* within a cycle that the position has begun */
    }
    s->moving = 1;
    return 1;
}

double knurl_locked_step(const knurl_grating *grating, knurl_grating_state *state, const double position[2],
                         const double velocity[2], double frequency, knurl_grating_output *output) {
    const int32_t direction = state->direction;
    double before = state->phase;
    state->phase = find_phase(grating, state, position, velocity, frequency);
    if (state->direction != direction) { /* back over the same ridges: the count begins anew, from here */
        before = state->phase;
        state->moving = 0;
    }
    if (!state->playing && event_begins(grating, state, before, frequency)) {
        const double period = fmax(2.0, grating->update_rate_hz / frequency);
        knurl_event_prepare(choose_length(period, state->phase - state->played), grating->amplitude, &state->event);
        state->played += 1.0;
        state->playing = 1;
        state->next_tick = 0;
        state->event_count++;
    }
    if (!state->playing) {
        return state->phase - floor(state->phase) < 0.5 ? grating->amplitude : -grating->amplitude;
    }
    output->event = state->event_count - 1;
    const double height = knurl_event_value(&state->event, state->next_tick);
    state->next_tick++;
    state->playing = state->next_tick < state->event.length;
    return height;
}

/* The method LOCKED: above a crossover frequency, balanced events whose lengths follow the ridges of the surface; below
 * it, the height at the position. Phases count cycles in the direction of motion; a cycle begins at a ridge's
 * rising edge (Eq. 11's, one quarter before a crest of its cosine). SPDX-License-Identifier: MIT */
#include "grating/locked.h"

#include "grating/phase.h"
#include "vibration/event.h"

#include <math.h>

/* The haptic Weber fraction for frequencies that the paper uses (figure 3). */
#define JND 0.38

/* Two positions one quantum apart differ by a quantum times at most this. */
#define ROUNDED 1.000001

/* Per tick. Larger or NaN increments are dropped; the phase stays finite. */
#define MOST_CYCLES 1e6

/* Follows the position on a grating with ridges along one axis. It has moved when it went forwards, or back by more
 * than a quantum: an encoder that toggles between two counts on a ridge's edge does not toggle the height. */
static double follow(const knurl_grating *g, knurl_grating_state *s, double place, double velocity) {
    if (s->direction == 0) {
        s->direction = velocity < 0.0 ? -1 : 1;
        s->held = place;
    }
    const double ahead = s->direction * (place - s->held);
    if (ahead < -ROUNDED * g->resolution) {
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
    if (fs[1 - along] > 0.0 || !position) { /* Eq. 12 counts cycles along the path, not by position */
        const double cycles = frequency / g->update_rate_hz;
        s->direction = 1;
        return s->phase + (cycles < MOST_CYCLES ? cycles : 0.0);
    }
    const double cycles = fs[along] * follow(g, s, position[along], velocity[along]);
    /* forwards the height rises a quarter cycle before each crest, backwards a quarter cycle after it */
    return s->direction * cycles + 0.25;
}

/* The length of the next event, ticks, which begins at phase `late` of its cycle. It ends with the cycle if the length
 * that this takes is within the JND of the period; else it comes as near to that as the JND allows. */
static int32_t choose_length(double period, double late) {
    const double least = period / (1.0 + JND);
    const double most = period * (1.0 + JND);
    const int32_t below = (int32_t)period;
    const int32_t above = below + (below < period);
    int32_t shortest = (int32_t)least;
    shortest += shortest < least;
    shortest = shortest < below ? shortest : below;
    const int32_t longest = (int32_t)most > above ? (int32_t)most : above;
    const double wanted = period * (1.0 - late) + 0.5;
    const int32_t length = !(wanted < longest) ? longest : wanted < shortest ? shortest : (int32_t)wanted;
    return length;
}

/* An event follows another one. If the events are a cycle or more ahead of the phase or behind it, drops whole cycles
 * until they are within half a cycle; where f_t is above f_h/2, always. */
static void drop_cycles(const knurl_grating *g, knurl_grating_state *s, double phase, double frequency) {
    const double debt = phase - s->played;
    if (frequency > 0.5 * g->update_rate_hz || !(fabs(debt) < 1.0)) {
        s->played += knurl_whole_cycles(debt + 0.5);
    }
}

/* 1 if a cycle begins at this tick, so that an event may begin. Then sets s->played to the phase of its start. */
static int is_boundary(knurl_grating_state *s, double phase, double before, double half_tick) {
    const double whole = knurl_whole_cycles(phase);
    const double into = phase - whole;
    const int begins = into > 1.0 - half_tick || into <= half_tick || (before < whole && into < 0.5);
    if (begins) {
        s->played = into > 1.0 - half_tick ? whole + 1.0 : whole;
    }
    return begins;
}

/* 1 if an event begins at this tick. */
static int event_begins(const knurl_grating *g, knurl_grating_state *s, double phase, double before, double frequency,
                        double lowest) {
    if (!(frequency >= lowest)) {
        s->moving = 0;
    } else if (s->moving) {
        drop_cycles(g, s, phase, frequency);
    } else {
        s->moving = is_boundary(s, phase, before, 0.5 * frequency / g->update_rate_hz);
    }
    return s->moving;
}

int knurl_locked_play(const knurl_grating *grating, knurl_grating_state *state, double phase, double before,
                      double frequency, double lowest, double *height) {
    if (!state->playing) {
        if (!event_begins(grating, state, phase, before, frequency, lowest)) {
            return 0;
        }
        const double period = grating->update_rate_hz / frequency;
        const int32_t length = choose_length(period > 2.0 ? period : 2.0, phase - state->played);
        knurl_vibration_event_set_length(length, grating->amplitude, &state->event);
        state->played += 1.0;
        state->playing = 1;
        state->next_tick = 0;
        state->event_count++;
    }
    *height = knurl_vibration_event_value(&state->event, state->next_tick);
    state->next_tick++;
    state->playing = state->next_tick < state->event.length;
    return 1;
}

/* Cycles by which an event may be ahead of the position as it ends, because the hand slows down: then what is left of
 * the ridge that it has played, a tenth at most, is not felt as another one. Where events are farther ahead, the speed
 * was wrong, or the grating has changed, and the place decides. With 0.75, a speed that is the difference of counts
 * would push with 0.68 A at 5 kHz, not with 0.29 A. */
#define MOST_AHEAD 0.6

/* 1 where the position is on a ridge that an event has played. */
static int was_played(knurl_grating_state *s) {
    if (!(s->played - s->phase < MOST_AHEAD)) {
        s->played = s->phase;
    }
    return s->played > s->phase;
}

double knurl_locked_step(const knurl_grating *grating, knurl_grating_state *state, const double position[2],
                         const double velocity[2], double frequency, knurl_grating_output *output) {
    const double fastest = 0.25 * grating->update_rate_hz;
    const double usual = KNURL_LOCKED_CROSSOVER_HZ < fastest ? KNURL_LOCKED_CROSSOVER_HZ : fastest;
    const double lowest = grating->crossover_hz > 0.0 ? grating->crossover_hz : usual;
    const int32_t direction = state->direction;
    double before = state->phase;
    double height;
    state->phase = find_phase(grating, state, position, velocity, frequency);
    if (state->direction != direction) { /* back over the same ridges: counts from here */
        before = state->played = state->phase;
        state->moving = 0;
    }
    if (!knurl_locked_play(grating, state, state->phase, before, frequency, lowest, &height)) {
        return knurl_first_half(state->phase) && !was_played(state) ? grating->amplitude : -grating->amplitude;
    }
    output->event = state->event_count - 1;
    return height;
}

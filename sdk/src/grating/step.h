/* One tick of a grating, inlined into a scene's tick: with a call, a plane's tick takes a tenth longer. Functions that
 * are not inlined are given copies, so that the values themselves can stay in registers. SPDX-License-Identifier: MIT
 */
#ifndef KNURL_SRC_STEP_H
#define KNURL_SRC_STEP_H

#include "grating/area.h"
#include "grating/locked.h"
#include "vibration/event.h"

/* Where a HIP is on a grating, and how fast it moves there. */
typedef struct knurl_grating_input {
    double position[2]; /* m; not used unless has_position */
    double velocity[2]; /* m/s */
    int32_t has_position;
} knurl_grating_input;

/* Begins an event of S2, which is rare: called by knurl_grating_run(). speed2: m^2/s^2. frequency: Hz. 0: none begins.
 */
int knurl_grating_begin_s2(const knurl_grating *grating, knurl_grating_state *state, double speed2,
                           double frequency) KNURL_NONBLOCKING;

/* The height of the tick of a mixed event: Algorithm 5. Rare, too. */
double knurl_grating_mixed_height(const knurl_grating_state *state) KNURL_NONBLOCKING;

/* How often ridges are crossed along x or along y, whichever is more often, Hz (Eq. 12). */
static inline double knurl_grating_highest(const double spatial_frequency[2], const double velocity[2]) {
    const double along_x = spatial_frequency[0] * fabs(velocity[0]);
    const double along_y = spatial_frequency[1] * fabs(velocity[1]);
    return along_x > along_y ? along_x : along_y;
}

/* Whether a half cycle begins. */
static inline void knurl_grating_note_turn(knurl_grating_state *state, knurl_grating_output *output) {
    const int32_t sign = (output->height > 0.0) - (output->height < 0.0);
    output->turned = sign * state->sign < 0;
    state->sign = sign ? sign : state->sign;
}

/* The latest ridge to begin: AREA's events. One of LOCKED's, which begins on a ridge, has been counted. */
static inline int64_t knurl_grating_count_ridges(knurl_grating_state *state, double height) {
    state->event_count += (height > 0.0) & (state->sign <= 0) & (state->next_tick == 0); /* no branch to mispredict */
    return state->event_count - 1;
}

/* Field by field: an assignment copies more at once than was just stored, which a processor has to wait for. */
static inline void knurl_grating_copy(const knurl_grating *from, knurl_grating *to) {
    to->method = from->method;
    to->spatial_frequency[0] = from->spatial_frequency[0];
    to->spatial_frequency[1] = from->spatial_frequency[1];
    to->amplitude = from->amplitude;
    to->update_rate_hz = from->update_rate_hz;
    to->resolution = from->resolution;
    to->crossover_hz = from->crossover_hz;
}

/* LOCKED and AREA. */
static inline void knurl_grating_follow(const knurl_grating *grating, knurl_grating_state *state,
                                        const knurl_grating_input *input, knurl_grating_output *output) {
    const double place[2] = {input->position[0], input->position[1]};
    const double velocity[2] = {input->velocity[0], input->velocity[1]};
    const double *position = input->has_position ? place : NULL;
    const double frequency = output->temporal_frequency;
    knurl_grating g;
    knurl_grating_output out;
    knurl_grating_copy(grating, &g);
    out.event = output->event;
    out.saturated = output->saturated;
    if (g.method == KNURL_METHOD_LOCKED) {
        output->height = knurl_locked_step(&g, state, position, velocity, frequency, &out);
        output->event = out.event;
    } else {
        output->height = knurl_area_step(&g, state, position, velocity, frequency, &out);
        output->event = knurl_grating_count_ridges(state, output->height);
        output->saturated = out.saturated;
    }
}

static inline int knurl_grating_begins_s2(const knurl_grating *grating, knurl_grating_state *state, double speed2,
                                          double frequency) {
    knurl_grating g;
    knurl_grating_copy(grating, &g);
    return knurl_grating_begin_s2(&g, state, speed2, frequency);
}

/* knurl_grating_step() without its checks. */
static inline void knurl_grating_run(const knurl_grating *grating, knurl_grating_state *state,
                                     const knurl_grating_input *input, knurl_grating_output *output) {
    const double *velocity = input->velocity;
    const double speed2 = velocity[0] * velocity[0] + velocity[1] * velocity[1];
    const double frequency = knurl_grating_highest(grating->spatial_frequency, velocity);
    output->height = 0.0;
    output->spatial_frequency = speed2 > 0.0 ? frequency / sqrt(speed2) : 0.0;
    output->temporal_frequency = frequency;
    output->event = KNURL_NO_EVENT;
    output->saturated = frequency > 0.5 * grating->update_rate_hz;
    output->reserved = 0;
    if (grating->method >= KNURL_METHOD_LOCKED) { /* or AREA */
        knurl_grating_follow(grating, state, input, output);
    } else if (state->playing ||
               (grating->method == KNURL_METHOD_S2 && knurl_grating_begins_s2(grating, state, speed2, frequency))) {
        output->height = state->event.kind == KNURL_EVENT_MIXED /* also one that another method began */
                             ? knurl_grating_mixed_height(state)
                             : knurl_vibration_event_level(&state->event, state->next_tick);
        output->event = state->event_count - 1;
        state->next_tick++;
        state->playing = state->next_tick < state->event.length;
    } else if (grating->method == KNURL_METHOD_S1) {
        const double position[2] = {input->position[0], input->position[1]};
        const double fs[2] = {grating->spatial_frequency[0], grating->spatial_frequency[1]};
        output->height = knurl_grating_s1(position, fs, grating->amplitude);
    }
    knurl_grating_note_turn(state, output);
}

#endif

/* One tick of an event, inlined into a scene's tick. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_PLAY_H
#define KNURL_SRC_PLAY_H

#include <knurl/grating.h>

#include "vibration/event.h"

/* The height of the tick of a mixed event, Algorithm 5: rare. */
double knurl_grating_mixed_height(const knurl_grating_state *state) KNURL_NONBLOCKING;

/* Plays the next tick of an event. */
static inline double knurl_grating_play(knurl_grating_state *state, knurl_grating_output *output) {
    const double height = state->event.kind == KNURL_EVENT_MIXED
                              ? knurl_grating_mixed_height(state)
                              : knurl_vibration_event_level(&state->event, state->next_tick);
    output->event = state->event_count - 1;
    state->next_tick++;
    state->playing = state->next_tick < state->event.length;
    return height;
}

#endif

/* The rare part of play.h, out of line. SPDX-License-Identifier: MIT */
#include "grating/play.h"

#include "base/finite.h"

double knurl_grating_mixed_height(const knurl_grating_state *state) {
    return knurl_vibration_event_value(&state->event, state->next_tick);
}

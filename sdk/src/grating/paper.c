/* The paper's methods: S1 (Eq. 11) and S2 (Algorithm 7 with Eqs. 12, 13). SPDX-License-Identifier: MIT */
#include "grating/method.h"

#include "grating/follow.h"
#include "grating/play.h"
#include "vibration/ticks.h"

/* Eq. 11, decided on fractional phases: cos(2 pi p) is positive while p + 1/4 is in the first half of its cycle. A
 * checkerboard, or bars if one frequency is 0. */
double knurl_s1_height(const knurl_grating *grating, knurl_grating_state *state, knurl_along position,
                       knurl_along velocity, double period, int32_t has_position, knurl_grating_output *output) {
    (void)state, (void)velocity, (void)period, (void)has_position, (void)output;
    const int along_x = knurl_first_half(position.x * grating->spatial_frequency[0] + 0.25);
    const int along_y = knurl_first_half(position.y * grating->spatial_frequency[1] + 0.25);
    return along_x == along_y ? grating->amplitude : -grating->amplitude;
}

/* Algorithm 7 as the paper means it: the event keeps its kind and amplitude to its end. */
double knurl_s2_height(const knurl_grating *grating, knurl_grating_state *state, knurl_along position,
                       knurl_along velocity, double period, int32_t has_position, knurl_grating_output *output) {
    (void)position, (void)period, (void)has_position;
    const double ticks = grating->update_rate_hz / output->temporal_frequency; /* infinite across no ridge */
    const double least = state->moving ? 0.5 * KNURL_S2_DEADBAND : KNURL_S2_DEADBAND;
    state->moving = 0;
    if (!(velocity.x * velocity.x + velocity.y * velocity.y >= least * least) || !(ticks <= KNURL_MAX_PERIOD_TICKS)) {
        return 0.0;
    }
    state->moving = grating->resolution > 0.0;
    knurl_vibration_event_fill(ticks, grating->amplitude, &state->event);
    state->next_tick = 0;
    state->event_count++;
    return knurl_grating_play(state, output);
}

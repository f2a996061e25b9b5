/* One tick of a grating, inlined into a scene's tick. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_STEP_H
#define KNURL_SRC_STEP_H

#include "grating/method.h"
#include "grating/play.h"

#include <math.h>

/* How often ridges are crossed along x or along y, whichever is more often, Hz (Eq. 12). */
static inline double knurl_grating_highest(const double spatial_frequency[2], knurl_along velocity) {
    const double along_x = spatial_frequency[0] * fabs(velocity.x);
    const double along_y = spatial_frequency[1] * fabs(velocity.y);
    return along_x > along_y ? along_x : along_y;
}

/* Whether a half cycle begins. */
static inline void knurl_grating_note_turn(knurl_grating_state *state, knurl_grating_output *output) {
    const int32_t sign = (output->height > 0.0) - (output->height < 0.0);
    output->turned = sign * state->sign < 0;
    state->sign = sign ? sign : state->sign;
}

/* knurl_grating_step() without its checks. method: the grating's. An event plays to its end, also one that another
 * method began. */
static inline void knurl_grating_run(const knurl_method *method, const knurl_grating *grating,
                                     knurl_grating_state *state, const knurl_grating_input *input,
                                     knurl_grating_output *output) {
    const knurl_along v = input->velocity;
    const double speed2 = v.x * v.x + v.y * v.y;
    const double frequency = knurl_grating_highest(grating->spatial_frequency, v);
    output->spatial_frequency = speed2 > 0.0 ? frequency / sqrt(speed2) : 0.0;
    output->temporal_frequency = frequency;
    output->event = KNURL_NO_EVENT;
    output->above_nyquist = frequency > 0.5 * grating->update_rate_hz;
    output->height =
        state->playing ? knurl_grating_play(state, output)
                       : method->height(grating, state, input->position, v, input->period, input->has_position, output);
    knurl_grating_note_turn(state, output);
}

#endif

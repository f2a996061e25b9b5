/* The method LOCKED, one tick at a time. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_LOCKED_H
#define KNURL_SRC_LOCKED_H

#include <knurl/grating.h>

/* The height of this tick. frequency: Hz, of this motion. position: null if unknown. Sets output->event. */
double knurl_locked_step(const knurl_grating *grating, knurl_grating_state *state, const double position[2],
                         const double velocity[2], double frequency, knurl_grating_output *output) KNURL_NONBLOCKING;

/* Events from `lowest` (Hz) on, in step with `phase`: cycles in the direction of motion, `before` a tick ago. 1, with
 * the height of the event that plays, or 0 where none does. */
int knurl_locked_play(const knurl_grating *grating, knurl_grating_state *state, double phase, double before,
                      double frequency, double lowest, double *height) KNURL_NONBLOCKING;

#endif

/* The method LOCKED, one tick at a time. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_LOCKED_H
#define KNURL_SRC_LOCKED_H

#include <knurl/grating.h>

/* The height of this tick. frequency: Hz, of this motion. position: null where there is none to go by. Sets
 * output->event. */
double knurl_locked_step(const knurl_grating *grating, knurl_grating_state *state, const double position[2],
                         const double velocity[2], double frequency, knurl_grating_output *output) KNURL_NONBLOCKING;

#endif

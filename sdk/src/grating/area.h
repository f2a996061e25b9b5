/* The method AREA, one tick at a time. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_AREA_H
#define KNURL_SRC_AREA_H

#include <knurl/grating.h>

/* The height of this tick. frequency: Hz, of this motion. position: null where there is none to go by: the way is then
 * the velocity's. Sets output->saturated where it jumps. */
double knurl_area_step(const knurl_grating *grating, knurl_grating_state *state, const double position[2],
                       const double velocity[2], double frequency, knurl_grating_output *output) KNURL_NONBLOCKING;

#endif

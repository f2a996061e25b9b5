/* Gains that make ridges equally strong at all speeds. SPDX-License-Identifier: MIT */
#ifndef KNURL_STUDY_EVEN_H
#define KNURL_STUDY_EVEN_H

#include <knurl/hip.h>

#define EVEN_GAINS 75 /* sixteenths of an octave from 20 Hz on, to 494 Hz */

/** Gains for bandlimited at 1 kHz on the device in a hand of steady_felt_weight(): what is felt of its ridges,
 * harmonics and image included, becomes as weak as at the weakest speed up to 300 Hz; above, at most. 0, or 1 if memory
 * runs out. */
int even_find(knurl_gain gains[EVEN_GAINS]);

/** What is felt of ridges of A = 1 at f_t, its unit without a meaning; negative if memory runs out. */
double even_felt(double hz);

#endif

/* Gains that make ridges equally strong at all speeds. SPDX-License-Identifier: MIT */
#ifndef KNURL_STUDY_EVEN_H
#define KNURL_STUDY_EVEN_H

#include <knurl/hip.h>

#define EVEN_GAINS 75 /* sixteenths of an octave, from 20 to 494 Hz */

/** Gains for bandlimited at 1 kHz, on the device and hand of steady_felt_weight(): reduce the felt level of its ridges,
 * including harmonics and images, to that of the weakest speed up to 300 Hz, or less above. 0, or 1 if memory runs out.
 */
int even_find(knurl_gain gains[EVEN_GAINS]);

/** The felt level of ridges of A = 1 at f_t, in an arbitrary unit; negative if memory runs out. */
double even_felt(double hz);

#endif

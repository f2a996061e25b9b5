/* How strongly ridges are felt. SPDX-License-Identifier: MIT */
#ifndef KNURL_STUDY_EVEN_H
#define KNURL_STUDY_EVEN_H

/** Felt strength of bandlimited's ridges of A = 1 at f_t and 1 kHz, harmonics and image included, on the device in a
 * hand of steady_felt_weight(); its unit has no meaning. Negative if memory runs out. */
double even_felt(double hz);

#endif

/* Even sensation: a gain of ridges' amplitude over f_t. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_EVEN_H
#define KNURL_SRC_EVEN_H

#include <knurl/hip.h>

/* From 2^LOWEST Hz on, sixteen values an octave, which a tick finds without a logarithm: the exponent of f_t and the
 * first four bits of its mantissa are the place. */
#define KNURL_EVEN_LOWEST 2
#define KNURL_EVEN_VALUES (16 * 12 + 1) /* to 16 kHz */

typedef struct knurl_even {
    int32_t on; /* 0: all gains are 1 */
    double lowest;
    double lowered_hz[2]; /* the first and the last pair below 1 */
    double gains[KNURL_EVEN_VALUES];
} knurl_even;

/* Errors: KNURL_ERROR_ARGUMENT; `even` is untouched. */
knurl_result knurl_even_init(const knurl_gain *gains, uint32_t count, knurl_even *even);

/* The gain at f_t (Hz), of an `even` that is on. */
double knurl_even_gain(const knurl_even *even, double frequency) KNURL_NONBLOCKING;

#endif

/* Loudness of a texture, by its effect on the force. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_LOUDNESS_H
#define KNURL_SRC_LOUDNESS_H

#include <knurl/hip.h>

#include <stdint.h>

typedef struct knurl_loudness {
    double heights[2], forces[3]; /* of the last ticks: m, N; [0] is the newest */
    uint32_t contact_ticks;       /* since contact began, up to 2 */
    uint32_t bucket_ticks, ticks; /* a bucket's length; ticks so far in this one */
    double buckets[2];            /* N: the largest change in this bucket and in the previous one */
    double rises[2];              /* m: the largest change of height with it */
    double powers[2], counts[2];  /* the sum of height^4 over the ticks whose height is not 0, and their number */
} knurl_loudness;

void knurl_loudness_init(knurl_loudness *loudness, double update_rate_hz);

/* N: half of the largest force change at an edge in the last one to two buckets, scaled from the height's change to its
 * level; 0 without contact. */
double knurl_loudness_update(knurl_loudness *loudness, const knurl_tick_output *tick) KNURL_NONBLOCKING;

#endif

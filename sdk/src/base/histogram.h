/* Percentiles of nanoseconds in fixed memory: log-linear buckets, 32 an octave (3 % wide). One writer, any readers.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_HISTOGRAM_H
#define KNURL_SRC_HISTOGRAM_H

#include "base/finite.h"

#include <knurl/base.h>

#define KNURL_HISTOGRAM_BUCKETS (32 * 60)

typedef struct knurl_histogram {
    uint64_t counts[KNURL_HISTOGRAM_BUCKETS];
    uint64_t total;
    uint64_t max;
} knurl_histogram;

/* [haptic thread] negative values count as 0 */
void knurl_histogram_add(knurl_histogram *histogram, int64_t value) KNURL_NONBLOCKING;

/* The value that a share (0..1) of the added values does not exceed, rounded to the bucket's middle; 0 if empty. */
double knurl_histogram_percentile(const knurl_histogram *histogram, double share);

#endif

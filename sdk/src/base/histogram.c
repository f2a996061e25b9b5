/* Log-linear histogram. SPDX-License-Identifier: MIT */
#include "base/histogram.h"

#include "base/atomic.h"

/* Values below 64 have a bucket each; above, the five bits after the leading one select it within the octave. */
static uint32_t bucket_of(uint64_t value) {
    uint32_t octave = 0;
    while (value >> octave >= 64) {
        octave++;
    }
    return octave * 32 + (uint32_t)(value >> octave);
}

static double middle_of(uint32_t bucket) {
    const uint32_t octave = bucket < 64 ? 0 : bucket / 32 - 1;
    const double width = (double)((uint64_t)1 << octave);
    return (double)(bucket - octave * 32) * width + 0.5 * (width - 1.0);
}

void knurl_histogram_add(knurl_histogram *histogram, int64_t value) {
    const uint64_t v = value > 0 ? (uint64_t)value : 0;
    knurl_count_up(&histogram->counts[bucket_of(v)]);
    knurl_count_up(&histogram->total);
    if (v > histogram->max) {
        knurl_store_relaxed(&histogram->max, v);
    }
}

double knurl_histogram_percentile(const knurl_histogram *histogram, double share) {
    const double wanted = share * (double)knurl_load_relaxed(&histogram->total);
    uint64_t seen = 0;
    for (uint32_t bucket = 0; bucket < KNURL_HISTOGRAM_BUCKETS; bucket++) {
        const uint64_t here = knurl_load_relaxed(&histogram->counts[bucket]);
        seen += here;
        if (here > 0 && (double)seen >= wanted) {
            return middle_of(bucket);
        }
    }
    return 0.0;
}

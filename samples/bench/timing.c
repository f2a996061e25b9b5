/* The clock, its own cost, and percentiles. SPDX-License-Identifier: MIT */
#include "bench.h"

#include <math.h>
#include <stdlib.h>
#include <time.h>

int64_t bench_now(void) {
    struct timespec now;
    (void)clock_gettime(CLOCK_MONOTONIC, &now);
    return (int64_t)now.tv_sec * 1000000000 + now.tv_nsec;
}

static int by_value(const void *a, const void *b) {
    const int64_t x = *(const int64_t *)a;
    const int64_t y = *(const int64_t *)b;
    return (x > y) - (x < y);
}

double bench_median(int64_t *samples, size_t count) {
    qsort(samples, count, sizeof *samples, by_value);
    const size_t middle = count / 2;
    return count > 0 ? (double)samples[middle] : 0.0;
}

double bench_timer_cost(int64_t *room, size_t count, double *step) {
    for (size_t i = 0; i < count; i++) {
        const int64_t before = bench_now();
        room[i] = bench_now() - before;
    }
    const double median = bench_median(room, count);
    *step = 0.0;
    for (size_t i = 0; i + 1 < count; i++) {
        const double apart = (double)(room[i + 1] - room[i]);
        *step = apart > 0.0 && (apart < *step || *step == 0.0) ? apart : *step;
    }
    return median;
}

/* The smallest sample that at least this share does not exceed (nearest rank). */
static double at(const int64_t *sorted, size_t count, double share, double timer_ns) {
    const size_t rank = (size_t)ceil(share * (double)count);
    return fmax(0.0, (double)sorted[rank > 0 ? rank - 1 : 0] - timer_ns);
}

void bench_percentiles(int64_t *samples, size_t count, double timer_ns, bench_result *result) {
    qsort(samples, count, sizeof *samples, by_value);
    result->p50_ns = at(samples, count, 0.5, timer_ns);
    result->p99_ns = at(samples, count, 0.99, timer_ns);
    result->p999_ns = at(samples, count, 0.999, timer_ns);
    result->max_ns = at(samples, count, 1.0, timer_ns);
}

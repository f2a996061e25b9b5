/* Timing and counting. SPDX-License-Identifier: MIT */
#include "cost.h"

#include "machine.h"
#include "statistics.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define BATCH   1000 /* ticks: a hundred times the clock's own cost */
#define BATCHES 301

static double now_ns(void) {
    struct timespec now;
    (void)clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec * 1e9 + (double)now.tv_nsec;
}

/* A tick without rendering. Called through a pointer, like the real one. */
static double empty_tick(void *subject) {
    study_rendering *r = subject;
    const uint64_t tick = r->tick++;
    return r->speed * (double)tick;
}

static double rendering_tick(void *subject) {
    return study_rendering_tick(subject);
}

void study_time_ticks(double (*tick)(void *), void *subject, study_cost *cost) {
    static double samples[BATCHES];
    double (*volatile call)(void *) = tick; /* neither is inlined */
    volatile double sink = 0.0;
    for (int batch = 0; batch < BATCHES; batch++) {
        const double before = now_ns();
        for (int i = 0; i < BATCH; i++) {
            sink = call(subject);
        }
        samples[batch] = (now_ns() - before) / BATCH;
    }
    (void)sink;
    cost->ns_median = quantile(samples, BATCHES, 0.5);
    cost->ns_p99 = quantile(samples, BATCHES, 0.99);
}

double study_empty_tick_ns(void) {
    study_rendering r;
    study_cost cost;
    memset(&r, 0, sizeof r);
    study_time_ticks(empty_tick, &r, &cost);
    return cost.ns_median;
}

int study_measure_cost(const study_contender *contender, study_cost *cost) {
    study_rendering r;
    const double empty = study_empty_tick_ns(); /* measured each time: the machine's speed drifts */
    if (study_rendering_start(&r, contender, 137.0)) {
        return 0;
    }
    study_time_ticks(rendering_tick, &r, cost);
    cost->ns_median = fmax(0.0, cost->ns_median - empty);
    cost->ns_p99 = fmax(0.0, cost->ns_p99 - empty);
    return 1;
}

/* Instructions of a whole run of knurl_tick_row; negative if they cannot be counted. */
static double count_run(const char *program, size_t index, unsigned long ticks) {
    char command[1400];
    char line[512];
    double counted = -1.0;
    (void)snprintf(command, sizeof command,
                   "valgrind --tool=callgrind --callgrind-out-file=/dev/null '%s' %lu %lu 2>&1 </dev/null", program,
                   (unsigned long)index, ticks);
    /* NOLINTNEXTLINE(bugprone-command-processor): the path contains no quote, the rest is constant */
    FILE *stream = popen(command, "r");
    while (stream && fgets(line, sizeof line, stream)) {
        const char *found = strstr(line, "Collected : ");
        counted = found ? strtod(found + strlen("Collected : "), NULL) : counted;
    }
    return stream && pclose(stream) == 0 ? counted : -1.0;
}

double study_count_instructions(size_t contender_index) {
    char program[1024];
    if (machine_program("knurl_tick_row", program, sizeof program) || strchr(program, '\'')) {
        return NAN;
    }
    const double once = count_run(program, contender_index, 10000);
    const double twice = once > 0.0 ? count_run(program, contender_index, 20000) : -1.0;
    return twice > 0.0 ? (twice - once) / 10000.0 : NAN;
}

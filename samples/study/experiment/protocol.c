/* The paper's design: cells, neighbours, order. SPDX-License-Identifier: MIT */
#include "experiment.h"

#include <string.h>

/* Section IV-A3: the odd periods within 43.1-500 Hz, and 400 Hz. */
static const double temporal_periods[] = {23, 21, 19, 17, 15, 13, 11, 9, 7, 5, 3, 2.5};
static const double spatial_periods[] = {0.5, 1, 2};

static const exp_design designs[] = {
    {1, {KNURL_WAVE_T1, KNURL_WAVE_T3}, {"T1", "T3"}, temporal_periods, 12, {1.05, 2.10}, 3, 48, "ms", "N"},
    {2, {KNURL_WAVE_T2, KNURL_WAVE_T3}, {"T2", "T3"}, temporal_periods, 12, {0.35, 0.70}, 3, 48, "ms", "N"},
    {3, {KNURL_METHOD_S1, KNURL_METHOD_S2}, {"S1", "S2"}, spatial_periods, 3, {0.27, 2.7}, 1, 3, "mm", "mm"}};

const exp_design *exp_design_of(int32_t experiment) {
    return experiment >= 1 && experiment <= 3 ? &designs[experiment - 1] : NULL;
}

void exp_neighbours(double medium_ms, double out[3]) {
    out[1] = medium_ms;
    if (medium_ms < 3.0) { /* 400 Hz: from 333 to 500 Hz (IV-B6) */
        out[0] = 3.0;
        out[2] = 2.0;
    } else {
        out[0] = medium_ms + 1.0;
        out[2] = medium_ms > 3.0 ? medium_ms - 1.0 : 2.5;
    }
}

/* splitmix64 (Steele, Lea, Flood 2014): any seed will do. */
static uint64_t next(uint64_t *state) {
    *state += 0x9e3779b97f4a7c15u;
    uint64_t z = *state;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

double exp_random(uint64_t *state) {
    return (double)(next(state) >> 11) / 9007199254740992.0;
}

static void shuffle(uint32_t *items, uint32_t count, uint64_t *state) {
    for (uint32_t i = count; i > 1; i--) {
        const uint32_t j = (uint32_t)(exp_random(state) * i);
        const uint32_t kept = items[i - 1];
        items[i - 1] = items[j];
        items[j] = kept;
    }
}

static void number_and_shuffle(uint32_t *items, uint32_t count, uint64_t *state) {
    for (uint32_t i = 0; i < count; i++) {
        items[i] = i;
    }
    shuffle(items, count, state);
}

/* One intensity's trials in one block: every period once, in random order; our method first in half of them, drawn
 * apart from the periods; where their number is odd, chance has the last one. */
static void plan_pairing(const exp_design *design, uint32_t block, double amplitude, uint64_t *state,
                         exp_trial *trials) {
    uint32_t periods[EXP_PERIODS];
    uint32_t orders[EXP_PERIODS];
    const uint32_t count = design->period_count;
    number_and_shuffle(periods, count, state);
    number_and_shuffle(orders, count, state);
    const uint32_t extra = exp_random(state) < 0.5 ? 0 : count % 2;
    for (uint32_t i = 0; i < count; i++) {
        const int ours_first = orders[i] < count / 2 + extra;
        trials[i].block = block;
        trials[i].period = design->periods[periods[i]];
        trials[i].amplitude = amplitude;
        trials[i].methods[0] = design->methods[ours_first];
        trials[i].methods[1] = design->methods[!ours_first];
    }
}

uint32_t exp_plan(const exp_design *design, uint64_t seed, int reduced, exp_trial trials[EXP_MAX_TRIALS]) {
    uint64_t state = seed + 0x100000000u * (uint64_t)design->experiment;
    uint32_t count = 0;
    memset(trials, 0, EXP_MAX_TRIALS * sizeof *trials);
    for (uint32_t block = 1; block <= design->blocks; block++) {
        uint32_t levels[2];
        number_and_shuffle(levels, 2, &state);
        for (uint32_t i = 0; i < 2; i++) {
            if (design->experiment == 3 && levels[i] != (reduced ? 0u : 1u)) {
                continue;
            }
            plan_pairing(design, block, design->amplitudes[levels[i]], &state, trials + count);
            count += design->period_count;
        }
    }
    return count;
}

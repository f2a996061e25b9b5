/* The design: cells, neighbours, order. SPDX-License-Identifier: MIT */
#include "experiment.h"

#include <string.h>

#define EXP_3_TICKS   60000 /* at least one minute per pair (IV-C4) */
#define COMPARE_TICKS 30000 /* per pair; each occurs four times */

/* Section IV-A3: the odd periods within 43.1-500 Hz, and 400 Hz. */
static const double temporal_periods[] = {23, 21, 19, 17, 15, 13, 11, 9, 7, 5, 3, 2.5};
static const double spatial_periods[] = {0.5, 1, 2};

static const exp_design designs[] = {
    {1, {KNURL_WAVE_T1, KNURL_WAVE_T3}, {"T1", "T3"}, temporal_periods, 12, {1.05, 2.10}, 3, 48, "ms", "N", 0, 0},
    {2, {KNURL_WAVE_T2, KNURL_WAVE_T3}, {"T2", "T3"}, temporal_periods, 12, {0.35, 0.70}, 3, 48, "ms", "N", 0, 0},
    {3,
     {KNURL_METHOD_S1, KNURL_METHOD_S2},
     {"S1", "S2"},
     spatial_periods,
     3,
     {0.27, 2.7},
     1,
     3,
     "mm",
     "mm",
     EXP_3_TICKS,
     0}};

const exp_design *exp_design_of(int32_t experiment) {
    return experiment >= 1 && experiment <= 3 ? &designs[experiment - 1] : NULL;
}

int exp_compare(int32_t one, int32_t other, exp_design *design) {
    const int32_t first = one < other ? one : other;
    const int32_t second = one < other ? other : one;
    const exp_design compare = {EXP_COMPARE,
                                {first, second},
                                {knurl_method_name(first), knurl_method_name(second)},
                                spatial_periods,
                                3,
                                {0.27, 2.7},
                                4,
                                6,
                                "mm",
                                "mm",
                                COMPARE_TICKS,
                                KNURL_PROTECT_ALL};
    if (one == other) {
        return tool_error(TOOL_USAGE, "compare: expected two methods, found '%s' twice", compare.names[0]);
    }
    *design = compare;
    return TOOL_OK;
}

int exp_has_gratings(const exp_design *design) {
    return design->scan_ticks > 0;
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

void exp_shuffle(uint32_t *items, uint32_t count, uint64_t *state) {
    for (uint32_t i = count; i > 1; i--) {
        const uint32_t j = (uint32_t)(exp_random(state) * i);
        const uint32_t kept = items[i - 1];
        items[i - 1] = items[j];
        items[j] = kept;
    }
}

int exp_is_right(const exp_design *design, const exp_trial *trial, int side) {
    return exp_has_gratings(design) ? trial->faults[side] == EXP_GOOD : trial->methods[side] == design->methods[1];
}

/* A session's trials and their order. SPDX-License-Identifier: MIT */
#include "experiment.h"

#include <string.h>

static void number_and_shuffle(uint32_t *items, uint32_t count, uint64_t *state) {
    for (uint32_t i = 0; i < count; i++) {
        items[i] = i;
    }
    exp_shuffle(items, count, state);
}

/* The three periods of one intensity at which the rival is worst, by the simulated subject's measures: the paper does
 * not print its six. */
static void plan_worst(const exp_design *design, double amplitude, exp_trial *trials) {
    double badness[EXP_PERIODS];
    for (uint32_t i = 0; i < design->period_count; i++) {
        badness[i] = exp_progression_badness(design->methods[0], design->periods[i], amplitude);
    }
    for (uint32_t n = 0; n < EXP_TRAINING / 2; n++) {
        uint32_t worst = 0;
        for (uint32_t i = 1; i < design->period_count; i++) {
            worst = badness[i] > badness[worst] ? i : worst;
        }
        trials[n].period = design->periods[worst];
        trials[n].amplitude = amplitude;
        badness[worst] = -1.0;
    }
}

/* Each fault twice, on each side and with each method. 4 mm is not among the tested periods, and every method plays it
 * well at a hand's speeds. */
static void plan_faults(const exp_design *design, double amplitude, exp_trial *trials) {
    for (int32_t i = 0; i < EXP_TRAINING; i++) {
        trials[i].period = EXP_TRAINING_MM;
        trials[i].amplitude = amplitude;
        trials[i].methods[0] = design->methods[0];
        trials[i].methods[1] = design->methods[1];
        trials[i].faults[i % 2] = EXP_STEADY + i / 2;
    }
}

static void plan_training(const exp_design *design, uint64_t seed, double amplitude, exp_trial trials[EXP_TRAINING]) {
    exp_trial planned[EXP_TRAINING];
    uint32_t order[EXP_TRAINING];
    uint64_t state = ~seed + 0x100000000u * (uint64_t)design->experiment;
    memset(planned, 0, sizeof planned);
    if (exp_has_gratings(design)) {
        plan_faults(design, amplitude, planned);
    } else {
        plan_worst(design, design->amplitudes[0], planned);
        plan_worst(design, design->amplitudes[1], planned + EXP_TRAINING / 2);
        for (uint32_t i = 0; i < EXP_TRAINING; i++) { /* the better one is first in half of them */
            planned[i].methods[0] = design->methods[i % 2];
            planned[i].methods[1] = design->methods[!(i % 2)];
        }
    }
    number_and_shuffle(order, EXP_TRAINING, &state);
    for (uint32_t i = 0; i < EXP_TRAINING; i++) {
        trials[i] = planned[order[i]];
    }
}

/* One intensity's trials in one block: every period once, in random order; the second method first in half of them,
 * drawn independently of the periods; if their number is odd, the last one is random. */
static void plan_pairing(const exp_design *design, uint32_t block, double amplitude, uint64_t *state,
                         exp_trial *trials) {
    uint32_t periods[EXP_PERIODS];
    uint32_t orders[EXP_PERIODS];
    const uint32_t count = design->period_count;
    number_and_shuffle(periods, count, state);
    number_and_shuffle(orders, count, state);
    const uint32_t extra = exp_random(state) < 0.5 ? 0 : count % 2;
    for (uint32_t i = 0; i < count; i++) {
        const int second_first = orders[i] < count / 2 + extra;
        trials[i].block = block;
        trials[i].period = design->periods[periods[i]];
        trials[i].amplitude = amplitude;
        trials[i].methods[0] = design->methods[second_first];
        trials[i].methods[1] = design->methods[!second_first];
    }
}

/* Each cell of this block in the opposite order to the block before. */
static void mirror(const exp_trial *before, exp_trial *trials, uint32_t count) {
    for (uint32_t i = 0; i < count; i++) {
        for (uint32_t k = 0; k < count; k++) {
            if (before[k].period == trials[i].period) {
                trials[i].methods[0] = before[k].methods[1];
                trials[i].methods[1] = before[k].methods[0];
            }
        }
    }
}

uint32_t exp_plan(const exp_design *design, uint64_t seed, int reduced, int training,
                  exp_trial trials[EXP_MAX_TRIALS]) {
    uint64_t state = seed + 0x100000000u * (uint64_t)design->experiment;
    uint32_t count = 0;
    memset(trials, 0, EXP_MAX_TRIALS * sizeof *trials);
    if (training) {
        plan_training(design, seed, design->amplitudes[reduced ? 0 : 1], trials);
        count = EXP_TRAINING;
    }
    for (uint32_t block = 1; block <= design->blocks; block++) {
        uint32_t levels[2];
        number_and_shuffle(levels, 2, &state);
        for (uint32_t i = 0; i < 2; i++) {
            if (exp_has_gratings(design) && levels[i] != (reduced ? 0u : 1u)) {
                continue;
            }
            plan_pairing(design, block, design->amplitudes[levels[i]], &state, trials + count);
            if (design->experiment == EXP_COMPARE && block % 2 == 0) {
                mirror(trials + count - design->period_count, trials + count, design->period_count);
            }
            count += design->period_count;
        }
    }
    return count;
}

/* A trial of experiment 1 or 2, tick by tick. No ramp at a vibration's ends: the paper has none.
 * SPDX-License-Identifier: MIT */
#include "experiment.h"

#include <string.h>

int exp_progression(int32_t method, const double periods_ms[3], double amplitude, knurl_wave waves[3]) {
    for (int i = 0; i < 3; i++) {
        if (knurl_wave_prepare(method, 1e-3 * periods_ms[i], amplitude, EXP_RATE, &waves[i])) {
            return tool_error(TOOL_FAILURE, "%s", knurl_error_message());
        }
    }
    return TOOL_OK;
}

int exp_stimulus_init(const exp_trial *trial, exp_stimulus *stimulus) {
    double periods[3];
    memset(stimulus, 0, sizeof *stimulus);
    exp_neighbours(trial->period, periods);
    const int code = exp_progression(trial->methods[0], periods, trial->amplitude, stimulus->waves[0]);
    return code ? code : exp_progression(trial->methods[1], periods, trial->amplitude, stimulus->waves[1]);
}

double exp_stimulus_force(const exp_stimulus *stimulus, uint64_t tick) {
    const uint64_t each = EXP_PROGRESSION + EXP_BETWEEN_TICKS;
    const uint64_t within = tick % each;
    const uint64_t step = EXP_VIBRATION_TICKS + EXP_PAUSE_TICKS;
    if (tick >= EXP_TRIAL_TICKS || within >= EXP_PROGRESSION || within % step >= EXP_VIBRATION_TICKS) {
        return 0.0;
    }
    return knurl_wave_value(&stimulus->waves[tick / each][within / step], within % step) +
           (within / step == 1 ? stimulus->push[tick / each] : 0.0);
}

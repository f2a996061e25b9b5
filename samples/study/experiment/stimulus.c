/* A trial of experiment 1 or 2, tick by tick. No ramp at a vibration's ends: the paper has none.
 * SPDX-License-Identifier: MIT */
#include "experiment.h"

int exp_stimulus_init(const exp_trial *trial, exp_stimulus *stimulus) {
    double periods[3];
    exp_neighbours(trial->period, periods);
    for (int which = 0; which < 2; which++) {
        for (int i = 0; i < 3; i++) {
            if (knurl_wave_prepare(trial->methods[which], 1e-3 * periods[i], trial->amplitude, EXP_RATE,
                                   &stimulus->waves[which][i])) {
                return tool_error(TOOL_FAILURE, "%s", knurl_error_message());
            }
        }
    }
    return TOOL_OK;
}

double exp_stimulus_force(const exp_stimulus *stimulus, uint64_t tick) {
    const uint64_t each = EXP_PROGRESSION + EXP_BETWEEN_TICKS;
    const uint64_t within = tick % each;
    const uint64_t step = EXP_VIBRATION_TICKS + EXP_PAUSE_TICKS;
    if (tick >= EXP_TRIAL_TICKS || within >= EXP_PROGRESSION || within % step >= EXP_VIBRATION_TICKS) {
        return 0.0;
    }
    return knurl_wave_value(&stimulus->waves[tick / each][within / step], within % step);
}

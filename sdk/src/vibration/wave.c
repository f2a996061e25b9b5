/* Temporal signals: T1 (Algorithm 1), T2 (Algorithm 3, Eqs. 1-4), T3 (Algorithm 6). SPDX-License-Identifier: MIT */
#include "base/handle.h"
#include "vibration/ticks.h"

#include <knurl/vibration.h>

#include <math.h>

/* Algorithm 3: the even periods on either side, weighted to give the period (Eq. 1) and the energy (Eq. 2). */
static knurl_result init_mix(knurl_wave *wave) {
    const double period = wave->period_ticks; /* >= 2, so the lower part is never shorter than 2 */
    const double upper = 2.0 * ceil(0.5 * period);
    const double lower = 2.0 * floor(0.5 * period);
    if (upper == lower) { /* already even: Eqs. 3 and 4 would be 0/0, and one component is enough */
        wave->part_count = 1;
        return knurl_vibration_event_prepare(upper, wave->amplitude, &wave->parts[0]);
    }
    const double a = upper * fabs(period - lower);
    const double b = lower * fabs(upper - period);
    const double norm = sqrt(a * a + b * b);
    wave->part_count = 2;
    const knurl_result result = knurl_vibration_event_prepare(upper, wave->amplitude * a / norm, &wave->parts[0]);
    return result ? result : knurl_vibration_event_prepare(lower, wave->amplitude * b / norm, &wave->parts[1]);
}

knurl_result knurl_wave_prepare(int32_t method, double period_s, double amplitude, double update_rate_hz,
                                knurl_wave *wave) {
    if (KNURL_IS_NULL(wave)) {
        return KNURL_ERROR_ARGUMENT;
    }
    if (method != KNURL_WAVE_T1 && method != KNURL_WAVE_T2 && method != KNURL_WAVE_T3) {
        return knurl_fail(KNURL_ERROR_UNKNOWN,
                          "method: expected KNURL_WAVE_T1, KNURL_WAVE_T2 or KNURL_WAVE_T3, found %d", (int)method);
    }
    if (!(knurl_is_finite(period_s) && period_s > 0.0 && period_s <= 10.0)) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "period: expected above 0 and up to 10 s, found %g s", period_s);
    }
    if (!knurl_is_within(update_rate_hz, 1.0, 100000.0)) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "update rate: expected 1 to 100000 Hz, found %g Hz", update_rate_hz);
    }
    if (!(amplitude >= 0.0 && knurl_is_finite(amplitude))) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "amplitude: expected a finite number >= 0, found %g", amplitude);
    }
    const double ticks = knurl_snap_ticks(period_s * update_rate_hz);
    knurl_wave made = {0};
    made.method = method;
    made.amplitude = amplitude;
    made.above_nyquist = ticks < 2.0;
    made.period_ticks = ticks < 2.0 ? 2.0 : ticks;
    knurl_result result = KNURL_OK;
    if (method == KNURL_WAVE_T2) {
        result = init_mix(&made);
    } else if (method == KNURL_WAVE_T3) {
        made.part_count = 1;
        result = knurl_vibration_event_prepare(made.period_ticks, amplitude, &made.parts[0]);
    }
    if (!result) {
        *wave = made;
    }
    return result;
}

/* Algorithm 1, decided on the fractional phase. Periods that are whole quarters of a tick (the snapped ones) are
 * counted in integers, at any tick. For other periods, a tick within rounding of an edge (a relative 1e-15, some ulp)
 * counts as on it: 35 ticks are 15 periods of 7/3 ticks, and begin the sixteenth. */
static double sample(const knurl_wave *wave, uint64_t tick) {
    const double quarters = 4.0 * wave->period_ticks;
    if (quarters == floor(quarters)) {
        const uint64_t n = (uint64_t)quarters;
        return 2 * (4 * (tick % n) % n) < n ? wave->amplitude : -wave->amplitude;
    }
    const double halves = 2.0 * ((double)tick / wave->period_ticks);
    const double edge = floor(halves + 0.5);
    const double half = fabs(halves - edge) <= 1e-15 * edge ? edge : floor(halves);
    return fmod(half, 2.0) == 0.0 ? wave->amplitude : -wave->amplitude;
}

double knurl_wave_value(const knurl_wave *wave, uint64_t tick) {
    if (!wave) {
        return 0.0;
    }
    if (wave->method == KNURL_WAVE_T1) {
        return sample(wave, tick);
    }
    double value = 0.0;
    for (int32_t i = 0; i < wave->part_count; i++) {
        const knurl_vibration_event *part = &wave->parts[i];
        value += knurl_vibration_event_height(part, (int32_t)(tick % (uint64_t)part->length));
    }
    return value;
}

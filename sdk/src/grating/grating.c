/* Haptic gratings: S1 (Eqs. 10, 11), S2 (Algorithm 7 with Eqs. 12, 13), and what all methods share.
 * SPDX-License-Identifier: MIT */
#include <knurl/grating.h>

#include "base/base.h"
#include "base/handle.h"
#include "grating/phase.h"
#include "grating/step.h"
#include "vibration/ticks.h"

#include <math.h>
#include <string.h>

static const struct {
    int32_t method;
    const char *name;
} methods[] = {{KNURL_METHOD_S1, "S1"}, {KNURL_METHOD_S2, "S2"}, {KNURL_METHOD_LOCKED, "locked"}, {KNURL_METHOD_AREA, "area"}};

const char *knurl_method_name(int32_t method) {
    for (size_t i = 0; i < sizeof methods / sizeof *methods; i++) {
        if (methods[i].method == method) {
            return methods[i].name;
        }
    }
    return NULL;
}

knurl_result knurl_method_from_name(const char *name, int32_t *method) {
    if (KNURL_IS_NULL(name) || KNURL_IS_NULL(method)) {
        return KNURL_ERROR_ARGUMENT;
    }
    for (size_t i = 0; i < sizeof methods / sizeof *methods; i++) {
        if (strcmp(methods[i].name, name) == 0) {
            *method = methods[i].method;
            return KNURL_OK;
        }
    }
    return knurl_fail(KNURL_ERROR_UNKNOWN, "method: expected S1, S2, locked or area, found '%s'", name);
}

knurl_result knurl_grating_check(knurl_grating *grating) {
    if (KNURL_IS_NULL(grating)) {
        return KNURL_ERROR_ARGUMENT;
    }
    const uint32_t *reserved = grating->reserved;
    if (reserved[0] || reserved[1] || reserved[2]) { /* or a later version could not give them a meaning */
        return knurl_fail(KNURL_ERROR_ARGUMENT, "reserved: expected zeros, found [%lu, %lu, %lu]",
                          (unsigned long)reserved[0], (unsigned long)reserved[1], (unsigned long)reserved[2]);
    }
    const double *fs = grating->spatial_frequency;
    if (!(fs[0] >= 0.0 && knurl_is_finite(fs[0]) && fs[1] >= 0.0 && knurl_is_finite(fs[1]))) {
        return knurl_fail(KNURL_ERROR_ARGUMENT,
                          "spatial_frequency: expected finite numbers >= 0 (cycles/m), found [%g, %g]", fs[0], fs[1]);
    }
    if (!(grating->amplitude >= 0.0 && knurl_is_finite(grating->amplitude))) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "amplitude: expected a finite number >= 0 (m), found %g",
                          grating->amplitude);
    }
    if (!knurl_is_within(grating->update_rate_hz, 1.0, 100000.0)) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "update rate: expected 1 to 100000 Hz, found %g Hz",
                          grating->update_rate_hz);
    }
    if (!(grating->resolution >= 0.0 && knurl_is_finite(grating->resolution))) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "resolution: expected a finite number >= 0 (m), found %g",
                          grating->resolution);
    }
    if (!(grating->crossover_hz == 0.0 || (grating->crossover_hz >= 1.0 && knurl_is_finite(grating->crossover_hz)))) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "crossover: expected 0 or a finite number >= 1 (Hz), found %g Hz",
                          grating->crossover_hz);
    }
    if (grating->method < KNURL_METHOD_DEFAULT || grating->method > KNURL_METHOD_AREA) {
        return knurl_fail(KNURL_ERROR_UNKNOWN,
                          "method: expected KNURL_METHOD_S1, KNURL_METHOD_S2, KNURL_METHOD_LOCKED or KNURL_METHOD_AREA, found %d",
                          (int)grating->method);
    }
    grating->method = grating->method == KNURL_METHOD_DEFAULT ? KNURL_METHOD_LOCKED : grating->method;
    return KNURL_OK;
}

double knurl_grating_frequency(const double spatial_frequency[2], const double velocity[2]) {
    if (!spatial_frequency || !velocity) {
        return 0.0;
    }
    return knurl_grating_highest(spatial_frequency, velocity);
}

double knurl_grating_s1_line(double position, double spatial_frequency, double amplitude) {
    return knurl_first_half(position * spatial_frequency) ? amplitude : -amplitude;
}

double knurl_grating_s1(const double position[2], const double spatial_frequency[2], double amplitude) {
    if (!position || !spatial_frequency) {
        return 0.0;
    }
    /* cos(2 pi p) is positive where p + 1/4 is in the first half of its cycle. */
    const int x = knurl_first_half(position[0] * spatial_frequency[0] + 0.25);
    const int y = knurl_first_half(position[1] * spatial_frequency[1] + 0.25);
    return x == y ? amplitude : -amplitude;
}

/* Algorithm 7 as the paper means it: the event keeps its kind and amplitude to its end. */
int knurl_grating_begin_s2(const knurl_grating *grating, knurl_grating_state *state, double speed2, double frequency) {
    const double ticks = grating->update_rate_hz / frequency; /* infinite across no ridge */
    const double least = state->moving ? 0.5 * KNURL_S2_DEADBAND : KNURL_S2_DEADBAND;
    state->moving = 0;
    if (!(speed2 >= least * least) || !(ticks <= KNURL_MAX_PERIOD_TICKS)) {
        return 0;
    }
    state->moving = grating->resolution > 0.0;
    /* below a tick, however fast, it is played as 2 */
    knurl_vibration_event_prepare(ticks > 1.0 ? ticks : 1.0, grating->amplitude, &state->event);
    state->playing = 1;
    state->next_tick = 0;
    state->event_count++;
    return 1;
}

double knurl_grating_mixed_height(const knurl_grating_state *state) {
    return knurl_vibration_event_value(&state->event, state->next_tick);
}

void knurl_grating_step(const knurl_grating *grating, knurl_grating_state *state, const double position[2],
                        const double velocity[2], knurl_grating_output *output) {
    knurl_grating_input input = {{0.0, 0.0}, {0.0, 0.0}, position != NULL};
    if (KNURL_UNLIKELY(!grating || !state || !velocity || !output || (!position && grating->method == KNURL_METHOD_S1))) {
        return;
    }
    for (int i = 0; i < 2; i++) {
        input.position[i] = position ? position[i] : 0.0;
        input.velocity[i] = velocity[i];
    }
    knurl_grating_run(grating, state, &input, output);
}

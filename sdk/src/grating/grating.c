/* Haptic gratings: the checks that all methods share. SPDX-License-Identifier: MIT */
#include <knurl/grating.h>

#include "base/base.h"
#include "base/handle.h"
#include "base/rule.h"
#include "grating/step.h"

#include <math.h>

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
    if (grating->method == KNURL_METHOD_DEFAULT) {
        grating->method = KNURL_METHOD_BANDLIMITED;
    } else if (!knurl_method_name(grating->method)) {
        return knurl_fail(KNURL_ERROR_UNKNOWN,
                          "method: expected one of KNURL_METHOD_ or a number from knurl_method_add(), found %d",
                          (int)grating->method);
    }
    return KNURL_OK;
}

double knurl_grating_frequency(const double spatial_frequency[2], const double velocity[2]) {
    if (!spatial_frequency || !velocity) {
        return 0.0;
    }
    const knurl_along v = {velocity[0], velocity[1]};
    return knurl_grating_highest(spatial_frequency, v);
}

void knurl_grating_step(const knurl_grating *grating, knurl_grating_state *state, const double position[2],
                        const double velocity[2], knurl_grating_output *output) {
    KNURL_RULE(HAPTIC, state);
    if (KNURL_UNLIKELY(!grating || !state || !velocity || !output ||
                       (!position && knurl_methods[grating->method].needs_position))) {
        return;
    }
    const knurl_grating_input input = {{position ? position[0] : 0.0, position ? position[1] : 0.0},
                                       {velocity[0], velocity[1]},
                                       1.0 / grating->update_rate_hz,
                                       position != NULL};
    output->reserved = 0;
    knurl_grating_run(&knurl_methods[grating->method], grating, state, &input, output);
}

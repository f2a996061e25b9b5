/* Closed-form limits of a device. SPDX-License-Identifier: MIT */
#include "scene/bounds.h"

#include <knurl/grating.h>

void knurl_bounds_init(knurl_bounds *bounds, const knurl_hip_facts *facts, double scale) {
    bounds->scale = scale;
    bounds->friction = facts->viscous + KNURL_LIGHTEST_HAND;
    bounds->lag = (0.5 + facts->delay) * (1.0 / facts->rate);
    bounds->max_stiffness = facts->max_stiffness;
    bounds->max_force = facts->max_force;
    bounds->continuous_force = facts->continuous_force;
    bounds->quantum = facts->resolution * scale;
}

double knurl_bounds_stability(const knurl_bounds *bounds, double damping) {
    return (bounds->friction + damping * bounds->scale) / bounds->lag;
}

double knurl_bounds_stiffness(const knurl_bounds *bounds, double damping) {
    const double stable = knurl_bounds_stability(bounds, damping);
    return stable < bounds->max_stiffness ? stable : bounds->max_stiffness;
}

double knurl_swing(int32_t method) {
    switch (method) {
    case KNURL_METHOD_S1:
        return 2.0; /* +A, -A */
    case KNURL_METHOD_LOCKED:
        return 2.41421356237309505; /* +A of an even event, -sqrt(2) A at 3 ticks */
    case KNURL_METHOD_AREA:
        return 3.14159265358979324; /* 1/sinc(1/2) either way */
    default:
        return 2.87444560869411535; /* the mix: (2 + 3 sqrt(1/2))/sqrt(13) and -(2 + 3 sqrt(2))/sqrt(13) */
    }
}

double knurl_bounds_amplitude(const knurl_bounds *bounds, double stiffness, int32_t method) {
    const double peak = bounds->max_force / (stiffness * knurl_swing(method));
    const double steady = bounds->continuous_force / stiffness;
    return peak < steady ? peak : steady;
}

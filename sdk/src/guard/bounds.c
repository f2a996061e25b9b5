/* Closed-form limits of a device. SPDX-License-Identifier: MIT */
#include "guard/bounds.h"

#include "grating/methods.h"

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

double knurl_bounds_amplitude(const knurl_bounds *bounds, double stiffness, int32_t method) {
    const double peak = bounds->max_force / (stiffness * knurl_methods[method].swing);
    const double steady = bounds->continuous_force / stiffness;
    return peak < steady ? peak : steady;
}

/* The thermal model: heat follows the square of the force with one time constant. SPDX-License-Identifier: MIT */
#include "guard/heat.h"

#include <math.h>

void knurl_heat_init(knurl_heat *heat, const knurl_hip_facts *facts, int limits) {
    const double square = facts->continuous_force * facts->continuous_force;
    const int is_limited = limits && facts->max_force > facts->continuous_force;
    const double ratio = facts->max_force / facts->continuous_force;
    heat->square = 0.0;
    heat->share = -expm1(-1.0 / (facts->rate * facts->heat_time)); /* exact for a force that is held for the tick */
    heat->per_force = 1.0 / square;
    heat->warm = is_limited ? KNURL_HEAT_WARM * square : HUGE_VAL;
    heat->most = is_limited ? square : HUGE_VAL;
    heat->continuous = facts->continuous_force;
    heat->excess = ratio * ratio - 1.0;
    heat->max_force = facts->max_force;
}

double knurl_heat_limit_warm(const knurl_heat *heat) {
    const double left = (1.0 - knurl_heat_theta(heat)) / (1.0 - KNURL_HEAT_WARM);
    return heat->continuous * sqrt(1.0 + heat->excess * (left < 0.0 ? 0.0 : left));
}

void knurl_heat_hold(knurl_heat *heat, double force2, double ticks) {
    heat->square = knurl_heat_cap(heat, force2 + (heat->square - force2) * exp(ticks * log1p(-heat->share)));
}

/* The thermal model: theta follows the square of the force with one time constant. SPDX-License-Identifier: MIT */
#include "scene/heat.h"

#include <math.h>

void knurl_heat_init(knurl_heat *heat, const knurl_hip_facts *facts) {
    const double ratio = facts->max_force / facts->continuous_force; /* 0 where there is no limit */
    heat->theta = 0.0;
    heat->share = -expm1(-1.0 / (facts->rate * facts->heat_time)); /* exact for a force that is held for the tick */
    heat->per_force = 1.0 / (facts->continuous_force * facts->continuous_force);
    heat->continuous = facts->continuous_force;
    heat->excess = ratio > 1.0 ? ratio * ratio - 1.0 : 0.0;
    heat->max_force = facts->max_force;
}

double knurl_heat_limit_warm(const knurl_heat *heat) {
    const double left = (1.0 - heat->theta) / (1.0 - KNURL_HEAT_WARM);
    return heat->continuous * sqrt(1.0 + heat->excess * left);
}

/* The closed form of as many knurl_heat_add(). */
void knurl_heat_hold(knurl_heat *heat, double force2, double ticks) {
    const double to = force2 * heat->per_force;
    heat->theta = to + (heat->theta - to) * exp(ticks * log1p(-heat->share));
    heat->theta = heat->theta < 1.0 || heat->excess == 0.0 ? heat->theta : 1.0;
}

double knurl_heat_get(const knurl_heat *heat) {
    return heat->theta > 0.0 ? heat->theta * heat->continuous * heat->continuous : 0.0; /* endless: none is kept */
}

void knurl_heat_set(knurl_heat *heat, double square) {
    const double theta = square * heat->per_force;
    heat->theta = theta < 1.0 || heat->excess == 0.0 ? theta : 1.0;
}

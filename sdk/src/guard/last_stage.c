/* The last stage of a force before a device, and the thermal model of its motors: heat follows the square of the force
 * with one time constant. SPDX-License-Identifier: MIT */
#include "guard/last_stage.h"

#include <math.h>
#include <string.h>

/* s for a force to grow from zero to max_force, if no slew_rate is given. */
#define SLEW_TIME 0.005

void knurl_last_stage_init(knurl_last_stage *stage, uint32_t protections, double slew_rate,
                           const knurl_hip_facts *facts) {
    const double square = stage->heat.square;
    const double rate = slew_rate != KNURL_DEFAULT ? slew_rate : facts->max_force / SLEW_TIME;
    memset(stage, 0, sizeof *stage);
    stage->slew = protections & KNURL_PROTECT_SLEW ? rate / facts->rate : HUGE_VAL;
    knurl_heat_init(&stage->heat, facts, (protections & KNURL_PROTECT_HEAT) != 0);
    stage->heat.square = square;
}

/* Applies the gain to the force as limited by the heat, so that a ramp's full length is used. */
static void attenuate(const knurl_last_stage *stage, double gain, double force[3]) {
    const double length = vec3_length(force);
    const double most = knurl_heat_limit(&stage->heat);
    vec3_scale(length > most ? gain * (most / length) : gain, force, force);
}

/* The length of a force may fall freely, but not turn: the change is measured from the last force, shortened to the new
 * one. After a squeeze the fall is limited too, until it is over. most: N that the force may change by. */
static void limit_slew(knurl_last_stage *stage, double most, double force[3], uint32_t *flags) {
    double from[3];
    double change[3];
    const double latest2 = vec3_dot(stage->force, stage->force);
    const double new2 = vec3_dot(force, force);
    const int falls = vec3_dot(force, stage->force) < latest2;
    vec3_scale(stage->release || !(new2 < latest2) ? 1.0 : sqrt(new2 / latest2), stage->force, from);
    vec3_sub(force, from, change);
    const double change2 = vec3_dot(change, change);
    stage->release &= change2 > most * most && (falls || (*flags & KNURL_TICK_SQUEEZED));
    if (change2 > most * most) {
        vec3_madd(from, most / sqrt(change2), change, force);
        *flags |= KNURL_TICK_SLEW;
    }
}

void knurl_last_stage_limit_change(knurl_last_stage *stage, double gain, double steps, double force[3],
                                   uint32_t *flags) {
    const double free = stage->slew + gain * steps;
    stage->release |= (*flags & KNURL_TICK_SQUEEZED) != 0;
    if (gain < 1.0) {
        attenuate(stage, gain, force);
    }
    if (gain != 0.0 && !(vec3_distance2(force, stage->force) <= free * free)) {
        limit_slew(stage, free, force, flags);
    } else { /* zero gain: no force at once, even after a squeeze */
        stage->release = 0;
    }
}

void knurl_last_stage_note(knurl_last_stage *stage, const double force[3]) {
    vec3_copy(force, stage->force);
    stage->release = 0;
    knurl_heat_add(&stage->heat, vec3_dot(force, force));
}

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

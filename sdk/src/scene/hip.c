/* Sets up a HIP from its description and its device's properties. SPDX-License-Identifier: MIT */
#include "scene/hip.h"

#include "base/base.h"
#include "base/vec3.h"

#include <stddef.h>
#include <string.h>

void knurl_hip_desc_init(knurl_hip_desc *desc, uint32_t size) {
    const knurl_hip_desc defaults = {
        .resolution = -1.0, .viscous = -1.0, .delay = -1.0, .protections = KNURL_PROTECT_ALL};
    knurl_desc_write(&defaults, sizeof defaults, desc, size);
}

const knurl_hip_facts knurl_touch = {1000.0, 0.055e-3, 3.3, 0.88, 60.0, 0.5, 1.0, 1020.0};

static double above_zero(double given, double device) {
    return given > 0.0 ? given : device;
}

static double from_zero(double given, double device) {
    return given < 0.0 ? device : given; /* NaN is refused later */
}

/* What the description says counts, then what the device says; but no force beyond `strongest` (N). */
static knurl_hip_facts settle(const knurl_hip_desc *d, const knurl_hip_facts *device, double strongest) {
    const double max_force = d->max_force != 0.0 ? d->max_force : device->max_force; /* NaN is refused later */
    const knurl_hip_facts made = {d->update_rate_hz != 0.0 ? d->update_rate_hz : device->rate,
                                  from_zero(d->resolution, device->resolution),
                                  max_force > strongest ? strongest : max_force,
                                  above_zero(d->continuous_force, device->continuous_force),
                                  above_zero(d->heat_time, device->heat_time),
                                  from_zero(d->viscous, device->viscous),
                                  from_zero(d->delay, device->delay),
                                  above_zero(d->max_stiffness, device->max_stiffness)};
    return made;
}

static knurl_result check_protections(const knurl_hip_desc *d) {
    const struct {
        const char *name, *unit;
        double value, least, most;
    } numbers[] = {{"continuous_force", "N", d->continuous_force, 0.0, HUGE_VAL},
                   {"heat_time", "s", d->heat_time, 0.0, 1e9},
                   {"viscous", "N s/m", d->viscous, -HUGE_VAL, 1e9},
                   {"delay", "ticks", d->delay, -HUGE_VAL, 16.0},
                   {"max_stiffness", "N/m", d->max_stiffness, 0.0, HUGE_VAL},
                   {"slew_rate", "N/s", d->slew_rate, 0.0, HUGE_VAL}};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
        if (!(numbers[i].value >= numbers[i].least && numbers[i].value <= numbers[i].most)) {
            return knurl_fail(KNURL_ERROR_ARGUMENT, "knurl_hip_desc.%s: expected %g to %g %s, found %g",
                              numbers[i].name, numbers[i].least, numbers[i].most, numbers[i].unit, numbers[i].value);
        }
    }
    if (d->protections > KNURL_PROTECT_ALL || d->clamp > 1 || d->reserved != 0) {
        return knurl_fail(KNURL_ERROR_ARGUMENT,
                          "knurl_hip_desc: expected protections of KNURL_PROTECT_ bits, clamp 0 or 1 and reserved 0, "
                          "found %#x, %u, %u",
                          (unsigned)d->protections, (unsigned)d->clamp, (unsigned)d->reserved);
    }
    return KNURL_OK;
}

static knurl_result check_facts(const knurl_hip_facts *facts) {
    if (!knurl_is_within(facts->rate, KNURL_UPDATE_RATE_MIN, KNURL_UPDATE_RATE_MAX)) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "update rate: expected %g to %g Hz, found %g Hz", KNURL_UPDATE_RATE_MIN,
                          KNURL_UPDATE_RATE_MAX, facts->rate);
    }
    if (!(facts->max_force > 0.0 && knurl_is_finite(facts->max_force))) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "max_force: expected a finite number > 0 (N), found %g",
                          facts->max_force);
    }
    return KNURL_OK;
}

/* All of a HIP but its snapshot, which other threads read without the lock: it becomes that of a HIP before its first
 * tick as a tick would write it. */
static void replace(knurl_hip *hip, const knurl_hip *made) {
    const size_t published = offsetof(knurl_hip, published);
    const size_t after = offsetof(knurl_hip, given);
    memcpy(hip, made, published);
    memcpy((char *)hip + after, (const char *)made + after, sizeof *hip - after);
    knurl_snapshot_clear(&hip->published);
}

void knurl_hip_set_scale(knurl_hip *hip, double scale) {
    hip->quantum = 1.7320508075688772 * hip->facts.resolution * scale;
    knurl_guard_set_scale(&hip->guard, &hip->given, &hip->facts, scale);
}

knurl_result knurl_hip_set_up(knurl_hip *hip, const knurl_hip_desc *d, const knurl_hip_facts *device, double strongest,
                              double time) {
    knurl_hip made;
    const knurl_hip_facts facts = settle(d, device, strongest);
    memset(&made, 0, sizeof made);
    made.given = *d;
    made.given.workspace = NULL; /* the caller's; kept by value below */
    made.rate = facts.rate;
    knurl_result result = check_protections(d);
    result = result ? result : check_facts(&facts);
    result = result || !d->workspace ? result : knurl_workspace_check(d->workspace);
    result = result ? result : knurl_velocity_init(d->velocity_method, facts.resolution, facts.rate, &made.velocity);
    if (result) {
        return result;
    }
    made.centred = d->workspace == NULL;
    knurl_workspace_init(&made.workspace);
    if (d->workspace) {
        made.workspace = *d->workspace;
    }
    made.facts = facts;
    made.last.heat.square = hip->last.heat.square; /* motors do not cool because a scene is set up */
    knurl_last_stage_init(&made.last, d->protections, d->slew_rate, &facts);
    knurl_guard_init(&made.guard, d, &facts);
    knurl_hip_set_scale(&made, made.workspace.scale);
    for (int i = 0; i < 9; i++) {
        made.is_rotated |= made.workspace.rotation[i] != (i % 4 == 0 ? 1.0 : 0.0);
    }
    knurl_contacts_init(&made.contacts, 1.0 / facts.rate, time);
    made.contacts.max_visits = d->max_visits > 0 ? d->max_visits : KNURL_VISITS_MAX;
    replace(hip, &made);
    return KNURL_OK;
}

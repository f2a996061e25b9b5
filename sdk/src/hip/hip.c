/* Sets up a HIP from its description and its device's properties. SPDX-License-Identifier: MIT */
#include "hip/hip.h"

#include "base/base.h"
#include "base/number.h"
#include "base/vec3.h"

#include <stddef.h>
#include <string.h>

void knurl_hip_desc_init(knurl_hip_desc *desc, uint32_t size) {
    const knurl_hip_desc defaults = {.protections = KNURL_PROTECT_ALL,
                                     .update_rate_hz = KNURL_DEFAULT,
                                     .resolution = KNURL_DEFAULT,
                                     .max_force = KNURL_DEFAULT,
                                     .continuous_force = KNURL_DEFAULT,
                                     .heat_time = KNURL_DEFAULT,
                                     .viscous = KNURL_DEFAULT,
                                     .delay = KNURL_DEFAULT,
                                     .max_stiffness = KNURL_DEFAULT,
                                     .slew_rate = KNURL_DEFAULT};
    knurl_desc_write(&defaults, sizeof defaults, desc, size);
}

const knurl_hip_facts knurl_touch = {1000.0, 0.055e-3, 3.3, 0.88, 60.0, 0.5, 1.0, 1020.0};

#define FIELD(field, range, kind)                                                                                      \
    {                                                                                                                  \
        #field, offsetof(knurl_hip_desc, field), {                                                                     \
            range, kind                                                                                                \
        }                                                                                                              \
    }

static const knurl_field fields[] = {
    FIELD(update_rate_hz, KNURL_RANGE_RATE, KNURL_OR_DEFAULT),
    FIELD(resolution, KNURL_RANGE_QUANTUM, KNURL_OR_DEFAULT | KNURL_OR_ZERO),
    FIELD(max_force, KNURL_RANGE_HIP_FORCE, KNURL_OR_DEFAULT),
    FIELD(continuous_force, KNURL_RANGE_FORCE, KNURL_OR_DEFAULT | KNURL_OR_INFINITY),
    FIELD(heat_time, KNURL_RANGE_HEAT_TIME, KNURL_OR_DEFAULT),
    FIELD(viscous, KNURL_RANGE_VISCOUS, KNURL_OR_DEFAULT),
    FIELD(delay, KNURL_RANGE_DELAY, KNURL_OR_DEFAULT),
    FIELD(max_stiffness, KNURL_RANGE_STIFFNESS, KNURL_OR_DEFAULT | KNURL_OR_INFINITY),
    FIELD(slew_rate, KNURL_RANGE_SLEW, KNURL_OR_DEFAULT | KNURL_OR_INFINITY),
};

static double or_else(double given, double device) {
    return given != KNURL_DEFAULT ? given : device;
}

/* Values of the description take precedence over the device's; the force is at most `strongest` (N). Both are valid. */
static knurl_hip_facts settle(const knurl_hip_desc *d, const knurl_hip_facts *device, double strongest) {
    const knurl_hip_facts made = {or_else(d->update_rate_hz, device->rate),
                                  or_else(d->resolution, device->resolution),
                                  knurl_min(or_else(d->max_force, device->max_force), strongest),
                                  or_else(d->continuous_force, device->continuous_force),
                                  or_else(d->heat_time, device->heat_time),
                                  or_else(d->viscous, device->viscous),
                                  or_else(d->delay, device->delay),
                                  or_else(d->max_stiffness, device->max_stiffness)};
    return made;
}

static knurl_result check(const knurl_hip_desc *d) {
    const knurl_result result = knurl_fields_check("knurl_hip_desc", fields, sizeof fields / sizeof *fields, d);
    if (result) {
        return result;
    }
    if (d->protections > KNURL_PROTECT_ALL || d->clamp > 1 || d->reserved != 0) {
        return knurl_fail(KNURL_ERROR_ARGUMENT,
                          "knurl_hip_desc: expected protections of KNURL_PROTECT_ bits, clamp 0 or 1 and reserved 0, "
                          "found %#x, %u, %u",
                          (unsigned)d->protections, (unsigned)d->clamp, (unsigned)d->reserved);
    }
    return d->workspace ? knurl_workspace_check(d->workspace) : KNURL_OK;
}

/* Copies all of a HIP except its snapshot, which other threads read without the lock. The snapshot is cleared as a tick
 * would write it. */
static void replace(knurl_hip *hip, const knurl_hip *made) {
    const size_t published = offsetof(knurl_hip, published);
    const size_t after = offsetof(knurl_hip, given);
    memcpy(hip, made, published);
    memcpy((char *)hip + after, (const char *)made + after, sizeof *hip - after);
    knurl_snapshot_clear(&hip->published);
}

void knurl_hip_set_scale(knurl_hip *hip, double scale) {
    knurl_guard_set_scale(&hip->guard, &hip->given, &hip->facts, scale);
}

knurl_result knurl_hip_set_up(knurl_hip *hip, const knurl_hip_desc *d, const knurl_hip_facts *device, double strongest,
                              double time) {
    knurl_hip made;
    knurl_result result = check(d);
    if (result) {
        return result;
    }
    const knurl_hip_facts facts = settle(d, device, strongest);
    memset(&made, 0, sizeof made);
    made.given = *d;
    made.given.workspace = NULL; /* the caller's; kept by value below */
    result = knurl_velocity_prepare(KNURL_VELOCITY_AUTO, facts.resolution, facts.rate, &made.velocity);
    if (result) {
        return result;
    }
    made.centred = d->workspace == NULL;
    knurl_workspace_set_identity(&made.workspace);
    if (d->workspace) {
        made.workspace = *d->workspace;
    }
    made.facts = facts;
    made.even = hip->even;
    made.effects = hip->effects;
    made.last.heat.square = hip->last.heat.square; /* setting up a scene does not cool motors */
    knurl_last_stage_init(&made.last, d->protections, d->slew_rate, &facts);
    knurl_guard_init(&made.guard, d, &facts);
    knurl_hip_set_scale(&made, made.workspace.scale);
    for (int i = 0; i < 9; i++) {
        made.is_rotated |= made.workspace.rotation[i] != (i % 4 == 0 ? 1.0 : 0.0);
    }
    knurl_contacts_init(&made.contacts, 1.0 / facts.rate, time);
    replace(hip, &made);
    return KNURL_OK;
}

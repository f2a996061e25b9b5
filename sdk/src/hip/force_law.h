/* The force of a contact: velocity over the surface, the grating's height, Eq. 9, friction. Pure: the only state is the
 * candidate's grating and friction anchor. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_FORCE_LAW_H
#define KNURL_SRC_FORCE_LAW_H

#include "base/base.h"
#include "grating/step.h"
#include "guard/hip_facts.h"
#include "hip/even.h"
#include "hip/friction.h"
#include "proxy/contact_update.h"
#include "surface/surface_frame.h"

/* The HIP's motion in a tick. */
typedef struct knurl_hip_motion {
    const knurl_hip_clock *clock;
    const double *velocity; /* scene, m/s */
    const knurl_hip_facts *facts;
    const double *between; /* m, scene: from the measured position to the tracked one */
    const knurl_even *even;
} knurl_hip_motion;

/* The force of one contact. */
typedef struct knurl_contact_force {
    double force[3];    /* scene, N */
    double velocity[2]; /* of the HIP over the surface, in the surface's frame, m/s */
    double cycles[2];   /* position on the grating: coordinates times fsx, fsy */
    knurl_grating_output grating;
} knurl_contact_force;

/* The velocity of the HIP over the surface, in the shape's frame. */
static inline void relative_velocity(const knurl_hip_motion *hip, const knurl_active_contact *c, double local[3]) {
    const knurl_motion *motion = &c->record->motion;
    if (KNURL_UNLIKELY(!knurl_motion_is_over(motion, hip->clock->previous_time))) {
        double surface[3], over[3];
        knurl_motion_velocity(motion, hip->clock->time, hip->clock->period, c->candidate->proxy, surface);
        vec3_sub(hip->velocity, surface, over);
        knurl_pose_vector_to_own(c->pose, over, local);
    } else {
        knurl_pose_vector_to_own(c->pose, hip->velocity, local);
    }
}

/* Moves surface coordinates on to the tracked position. */
static inline void add_between(const double between[3], const knurl_active_contact *c, double coordinates[2]) {
    double own[3], way[2];
    knurl_pose_vector_to_own(c->pose, between, own);
    if (knurl_surface_rates(c->surface, c->record, &c->contact, own, way)) {
        coordinates[0] += way[0];
        coordinates[1] += way[1];
    }
}

/* Plays the grating for one tick. over: velocity in the shape's frame. coordinates: from knurl_surface_frame().
 * Functions that are not inlined get copies, so that the values themselves can stay in registers. */
static inline void play_grating(const knurl_hip_motion *hip, const knurl_active_contact *c, const double over[3],
                                knurl_along velocity, double coordinates[2], const knurl_wall *wall,
                                knurl_contact_force *out) {
    const knurl_material_desc *m = &c->record->material;
    knurl_grating_output played;
    knurl_candidate *candidate = c->candidate;
    if (KNURL_UNLIKELY(candidate->plays_edits != c->record->edits)) {
        knurl_candidate_set_grating(candidate, c->record, hip->facts);
    }
    knurl_surface_coordinates(c->surface, c->record, &c->contact, c->begins, &c->candidate->carry, coordinates);
    double rates[2] = {velocity.x, velocity.y};
    int32_t has_position = 1;
    if (c->record->method->follows_position) { /* without coordinates the method integrates the velocity */
        has_position = knurl_surface_rates(c->surface, c->record, &c->contact, over, rates);
        if (hip->facts->resolution > 0.0) {
            add_between(hip->between, c, coordinates);
        }
    }
    out->cycles[0] = m->spatial_frequency[0] * coordinates[0] + 0.0; /* turns -0 into 0 */
    out->cycles[1] = m->spatial_frequency[1] * coordinates[1] + 0.0;
    const knurl_grating_input at = {
        {coordinates[0], coordinates[1]}, {rates[0], rates[1]}, hip->clock->period, has_position};
    candidate->plays.amplitude = wall->amplitude;
    if (KNURL_UNLIKELY(hip->even->on)) {
        const double frequency = knurl_grating_highest(m->spatial_frequency, at.velocity);
        candidate->plays.amplitude *= knurl_even_gain(hip->even, frequency);
    }
    knurl_grating_run(c->record->method, &candidate->plays, &candidate->grating, &at, &played);
    out->grating = played;
}

/* The force of one contact. plays: 1: its grating plays. wall: as limited by the protections; its height is set here.
 */
static inline void knurl_force_law(const knurl_hip_motion *hip, const knurl_active_contact *c, int plays,
                                   knurl_wall *wall, knurl_contact_force *out) {
    double over[3], x[3], y[3], coordinates[2] = {0.0, 0.0};
    relative_velocity(hip, c, over);
    knurl_surface_frame(c->surface, c->record, &c->contact, x, y, coordinates);
    const knurl_along velocity = {vec3_dot(over, x), vec3_dot(over, y)};
    out->velocity[0] = velocity.x;
    out->velocity[1] = velocity.y;
    if (plays) {
        play_grating(hip, c, over, velocity, coordinates, wall, out);
    } else {
        const knurl_grating_output none = {.event = KNURL_NO_EVENT};
        out->grating = none;
        out->cycles[0] = out->cycles[1] = 0.0;
    }
    wall->height = out->grating.height;
    vec3_scale(knurl_normal_force(wall, c->share, vec3_dot(over, c->contact.normal)), c->normal, out->force);
    if (c->record->material.friction > 0.0) {
        double tangential[3], force[3];
        knurl_friction_force(c, wall, tangential);
        knurl_pose_vector_to_parent(c->pose, tangential, force);
        vec3_madd(out->force, c->friction_share, force, out->force);
    }
}

#endif

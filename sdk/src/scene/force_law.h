/* From a contact to a force: the velocity over the surface, the grating's height at it, Eq. 9, friction. Pure: what is
 * kept from tick to tick is the candidate's grating state and friction anchor. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_FORCE_LAW_H
#define KNURL_SRC_FORCE_LAW_H

#include "scene/contact_update.h"

/* How the HIP moves. */
typedef struct knurl_hip_motion {
    const knurl_hip_clock *clock;
    const double *velocity; /* scene, m/s */
    double rate;            /* Hz */
    double quantum;         /* m, scene: how far a position flickers at most that stands still: a count's diagonal */
} knurl_hip_motion;

/* What one contact comes to. */
typedef struct knurl_contact_force {
    double force[3];    /* scene, N */
    double velocity[2]; /* of the HIP over the surface, in the surface's frame, m/s */
    knurl_grating_output grating;
} knurl_contact_force;

/* The force of one contact. wall: as it is to be felt; gets its height. */
void knurl_force_law(const knurl_hip_motion *hip, const knurl_active_contact *contact, knurl_wall *wall,
                     knurl_contact_force *out) KNURL_NONBLOCKING;

#endif

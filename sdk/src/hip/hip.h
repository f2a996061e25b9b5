/* One haptic interaction point: its settings and its state from tick to tick. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_HIP_H
#define KNURL_SRC_HIP_H

#include "guard/guard.h"
#include "guard/last_stage.h"
#include "hip/effects.h"
#include "hip/even.h"
#include "hip/hip_workspace.h"
#include "hip/snapshot.h"
#include "proxy/contact_update.h"

/* A force that a game adds to those of surfaces, in one tick. */
typedef struct knurl_added_force {
    double force[3]; /* N, scene; finite */
    double step;     /* N: jump of a vibration in it, which the slew limit allows */
} knurl_added_force;

/* The fields of every tick are together, and the long list of candidates comes last: at 1 kHz all of this is cold in
 * the cache when a tick begins. */
typedef struct knurl_hip {
    uint64_t pinned;    /* atomic: epoch in which the running tick began; 0: no tick runs */
    int32_t is_rotated; /* 0: the workspace's rotation is the identity, and is skipped */
    int32_t centred;    /* 1: the scene chooses the workspace at its commit */
    knurl_workspace workspace;
    knurl_velocity velocity;
    knurl_guard guard;
    knurl_last_stage last;
    knurl_hip_counts counts;
    knurl_published published; /* read by any thread, without the lock */
    knurl_hip_desc given;      /* as configured; a loop fills in the open values */
    knurl_hip_facts facts;     /* in use */
    knurl_workspace_move move; /* of the workspace */
    knurl_even even;
    knurl_effects *effects; /* atomic: or null */
    double estimate[3];     /* m/s, device: the velocity, if it is estimated */
    double between[3];      /* m, scene: from the measured position to the tracked one */
    uint64_t tracked_at;    /* tick that found it, from 1; 0: none */
    knurl_contacts contacts;
} knurl_hip;

/* The Touch at 1 kHz: defaults for values that neither a HIP's description nor its device sets. */
extern const knurl_hip_facts knurl_touch;

/* Sets a HIP up anew. device: values that the description leaves open. strongest: N, limit on its max_force. time: s,
 * the scene's. Errors: KNURL_ERROR_ARGUMENT (which field); the HIP is unchanged. */
knurl_result knurl_hip_set_up(knurl_hip *hip, const knurl_hip_desc *desc, const knurl_hip_facts *device,
                              double strongest, double time);

/* Sets the values that depend on the workspace's scale. */
void knurl_hip_set_scale(knurl_hip *hip, double scale) KNURL_NONBLOCKING;

#endif

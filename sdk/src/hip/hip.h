/* One haptic interaction point: its settings and its state from tick to tick. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_HIP_H
#define KNURL_SRC_HIP_H

#include "guard/guard.h"
#include "guard/last_stage.h"
#include "hip/hip_workspace.h"
#include "hip/snapshot.h"
#include "proxy/contact_update.h"

/* A force that a game adds to what surfaces give, in one tick. */
typedef struct knurl_added_force {
    double force[3]; /* N, scene; finite */
    double step;     /* N: how far a vibration in it jumps, which the slew limit lets through */
} knurl_added_force;

/* The list of candidates, which is long, comes last: at 1 kHz a tick finds all of this in a cold cache. */
typedef struct knurl_hip {
    uint64_t pinned; /* atomic: the epoch in which the tick that runs began; 0: none runs */
    double rate;
    double quantum;     /* m, scene: how far a position flickers at most that stands still: a count's diagonal */
    int32_t is_rotated; /* 0: the workspace's rotation is 1, and is left out */
    int32_t centred;    /* 1: the scene chooses the workspace at its commit */
    knurl_workspace workspace;
    knurl_velocity velocity;
    knurl_guard guard;
    knurl_last_stage last;
    knurl_hip_counts counts;
    knurl_published published; /* read by any thread, without the lock */
    knurl_hip_desc given;      /* as configured; what it leaves open a loop fills in */
    knurl_hip_facts facts;     /* what is in use */
    knurl_workspace_move move; /* the workspace's */
    knurl_contacts contacts;
} knurl_hip;

/* The Touch at 1 kHz: what a HIP's description and its device leave open. */
extern const knurl_hip_facts knurl_touch;

/* Sets a HIP up anew; `device` stands for what the description leaves open, `strongest` (N) is the force that it has,
 * `time` (s) is the scene's. Errors: KNURL_ERROR_ARGUMENT (which field), and the HIP is as it was. */
knurl_result knurl_hip_set_up(knurl_hip *hip, const knurl_hip_desc *desc, const knurl_hip_facts *device,
                              double strongest, double time);

/* What depends on the workspace's scale, after that changed. */
void knurl_hip_set_scale(knurl_hip *hip, double scale) KNURL_NONBLOCKING;

#endif

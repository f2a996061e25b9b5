/* The internals of a scene. Edits hold its lock; ticks take no lock. Ticks follow atomic pointers to objects that are
 * immutable once published (records, shapes, the broad phase's index); an object that an edit replaces is kept until no
 * tick can use it (epoch.h). SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_SCENE_H
#define KNURL_SRC_SCENE_H

#include "base/handle.h"
#include "hip/hip.h"

#include <knurl/query.h>

/* In knurl_scene.use, above the bits of all HIPs: destroyed by its owner, kept for the loops that use it. */
#define KNURL_SCENE_DESTROYED 0x100u

struct knurl_scene {
    uint32_t handle; /* KNURL_HANDLE_SCENE */
    /* read by ticks */
    uint32_t hip_count;
    knurl_hip *hips;
    uint32_t committed; /* atomic: 1 once all data that ticks read is complete */
    uint32_t use;       /* atomic: bit i: a loop uses HIP i; KNURL_SCENE_DESTROYED */
    uint32_t full_model;
    knurl_broad_phase broad_phase;
    knurl_epoch epoch;

    /* for edits, under the lock */
    knurl_mutex *lock; /* taken by readers and writers */
    knurl_mutex mutexes[2];
    knurl_heap heap; /* locked by the second mutex */
    knurl_surfaces surfaces;
};

void knurl_scene_lock(const knurl_scene *scene);
void knurl_scene_unlock(const knurl_scene *scene);

/* Locks a scene and finds one of its surfaces; after an error it is not locked. Errors: KNURL_ERROR_ARGUMENT (scene),
 * KNURL_ERROR_STALE_ID. */
knurl_result knurl_scene_lock_surface(const knurl_scene *scene, knurl_surface_id id, knurl_surface_data **surface);

/* Call it with the scene locked. */
void knurl_scene_copy_name(const knurl_surface_data *surface, char name[KNURL_NAME_SIZE]);

/* s: the time of the HIP that is ahead. */
double knurl_scene_time(const knurl_scene *scene);

/* The centre of all surfaces' bounds; 0 in an empty scene. */
void knurl_scene_centre(const knurl_scene *scene, double centre[3]);

/* Checks that the scene has a HIP. Errors: KNURL_ERROR_ARGUMENT. */
knurl_result knurl_scene_check_hip(const knurl_scene *scene, uint32_t hip);

/* Claims a HIP for one loop and keeps the scene alive for it. Errors: KNURL_ERROR_ARGUMENT (hip), KNURL_ERROR_STATE
 * (another loop's, or the scene was destroyed). [any thread] */
knurl_result knurl_scene_claim_hip(knurl_scene *scene, uint32_t hip);

/* Releases the claim; frees a destroyed scene that no other loop uses. [any thread but a tick's] */
void knurl_scene_release_hip(knurl_scene *scene, uint32_t hip);

/* 1 if its owner has destroyed it. [any thread] */
int knurl_scene_is_destroyed(const knurl_scene *scene);

/* The tick of one of the scene's HIPs. The scene must be committed. added: or null. */
void knurl_hip_tick(knurl_scene *scene, knurl_hip *hip, const knurl_tick_input *input, const knurl_added_force *added,
                    knurl_tick_output *output) KNURL_NONBLOCKING;

/* Fills in the open values of a claimed HIP's description from the loop and its device, and clears the HIP's state
 * except for the heat. Errors: KNURL_ERROR_ARGUMENT (configured for another update rate). [game thread] */
knurl_result knurl_scene_adopt_device(knurl_scene *scene, uint32_t hip, const knurl_hip_facts *facts);

/* Publishes a force (N) that the loop sent at its end without a tick, as if it were the last tick's. On the HIP's
 * haptic thread, or after its end. */
void knurl_scene_publish_force(knurl_scene *scene, uint32_t hip, const double force[3],
                               const double device_force[3]) KNURL_NONBLOCKING;

#endif

/* What a scene is made of. Edited under its lock, read by ticks without one: what a tick follows are atomic pointers to
 * things that never change once they can be seen (records, shapes, the broad phase's index), and what an edit replaces
 * is kept until no tick can see it (epoch.h). SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_SCENE_H
#define KNURL_SRC_SCENE_H

#include "base/handle.h"
#include "scene/hip.h"

/* In knurl_scene.use: destroyed by its owner, kept for the loops that use it. Above the bits of all HIPs. */
#define KNURL_SCENE_DESTROYED 0x100u

struct knurl_scene {
    uint32_t handle; /* KNURL_HANDLE_SCENE */
    /* read by ticks */
    uint32_t hip_count;
    knurl_hip *hips;
    uint32_t committed; /* atomic: 1 once all that ticks read is there */
    uint32_t use;       /* atomic: bit i: a loop has HIP i; KNURL_SCENE_DESTROYED */
    uint32_t full_model;
    knurl_broad_phase broad_phase;
    knurl_epoch epoch;

    /* for edits, under the lock */
    knurl_mutex *lock; /* who only reads takes it too */
    knurl_mutex mutexes[2];
    knurl_heap heap; /* under the second */
    knurl_surfaces surfaces;
};

void knurl_scene_lock(const knurl_scene *scene);
void knurl_scene_unlock(const knurl_scene *scene);

/* s: the time of the HIP that is ahead. */
double knurl_scene_time(const knurl_scene *scene);

/* The centre of all surfaces' bounds; 0 in an empty scene. */
void knurl_scene_centre(const knurl_scene *scene, double centre[3]);

/* A loop takes a HIP, which from then on is the loop's alone, and keeps the scene in being. Errors:
 * KNURL_ERROR_ARGUMENT (hip), KNURL_ERROR_STATE (another loop's, or the scene was destroyed). [any thread] */
knurl_result knurl_scene_claim_hip(knurl_scene *scene, uint32_t hip);

/* The loop is done with it; frees a scene that was destroyed and that no other loop uses. [any thread but a tick's] */
void knurl_scene_release_hip(knurl_scene *scene, uint32_t hip);

/* 1: its owner has destroyed it. [any thread] */
int knurl_scene_is_destroyed(const knurl_scene *scene);

/* knurl_scene_tick() for the loop that has claimed the HIP. */
knurl_result knurl_hip_tick(knurl_scene *scene, uint32_t hip, const knurl_tick_input *input,
                            knurl_tick_output *output) KNURL_NONBLOCKING;

/* The scratch HIP of dry ticks: a copy of the claimed HIP that touches nothing, whose contacts share no memory with the
 * HIP's. [game thread, while the HIP does not tick] */
void knurl_hip_begin_dry(const knurl_scene *scene, uint32_t hip, knurl_hip *scratch);

/* A dry tick: a tick at the latest position (device, m) on the scratch HIP, whose force is dropped. It brings what the
 * claimed HIP's next tick will run and read into the cache. It takes as long as a tick with cold caches; the tick after
 * it takes a fifth of that. */
void knurl_hip_dry_tick(knurl_scene *scene, uint32_t hip, knurl_hip *scratch,
                        const double position[3]) KNURL_NONBLOCKING;

/* Fills in what a claimed HIP's description leaves open, as the loop and its device have it, and forgets what the HIP
 * did, but not how warm its motors are. Errors: KNURL_ERROR_ARGUMENT (another update rate was asked for). [game thread]
 */
knurl_result knurl_scene_adopt_device(knurl_scene *scene, uint32_t hip, const knurl_hip_facts *facts);

/* The force (N) that the loop sent without a tick, at its end: the latest tick's is told to be this one. Where the
 * HIP's haptic thread is, or after it has ended (motors.c). */
void knurl_scene_publish_force(knurl_scene *scene, uint32_t hip, const double force[3],
                               const double device_force[3]) KNURL_NONBLOCKING;

/* How warm the HIP's motors are (N^2, see knurl_heat_get()), and a force (its square, N^2) that they held for so many
 * ticks that nobody made. Where its haptic thread is, or while there is none (motors.c). */
void knurl_scene_set_heat(knurl_scene *scene, uint32_t hip, double square);
void knurl_scene_hold_force(knurl_scene *scene, uint32_t hip, double force2, double ticks) KNURL_NONBLOCKING;

#endif

/* What a scene is made of. Built on the game thread, read by ticks after the commit. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_SCENE_H
#define KNURL_SRC_SCENE_H

#include "base/heap.h"
#include "base/seqlock.h"
#include "contact/plane.h"

#include <knurl/scene.h>

typedef struct knurl_surface_data {
    char *name;
    knurl_material_desc material; /* method resolved */
    knurl_mesh *mesh;             /* null: a plane */
    knurl_plane plane;
    double position[3]; /* surface to scene */
    double rotation[9];
    double axis[3];       /* unit, surface frame; used where has_axis */
    double turn[2];       /* cosine and sine of the orientation */
    double reach;         /* the highest crest: m in front of the surface where contact begins */
    double bounds_min[3]; /* scene axes, m */
    double bounds_max[3];
    int32_t has_axis;
    int32_t double_sided;
    uint32_t generation;
    uint32_t alive;
} knurl_surface_data;

/* One surface that a HIP touches. */
typedef struct knurl_slot {
    uint32_t surface; /* index */
    uint32_t used;
    knurl_contact_state contact;
    knurl_grating_state grating;
} knurl_slot;

/* What any thread may read of a HIP. */
typedef struct knurl_snapshot {
    knurl_tick_output output;
    knurl_hip_counts counts;
} knurl_snapshot;

typedef struct knurl_hip {
    knurl_workspace workspace;
    knurl_velocity velocity;
    knurl_hip_desc given; /* as configured; what it leaves open a loop fills in */
    double rate;
    double max_force;
    double previous[3]; /* HIP position at the last tick, scene */
    int32_t has_previous;
    int32_t centred; /* 1: the scene chooses the workspace at its commit */
    knurl_slot slots[KNURL_MAX_CONTACTS];
    knurl_hip_counts counts;
    KNURL_SEQLOCK(knurl_snapshot) published;
} knurl_hip;

struct knurl_scene {
    knurl_heap heap;
    knurl_surface_data *surfaces; /* places are reused, ids are not */
    uint32_t *order;              /* places of living surfaces, in the order of adding */
    uint32_t surface_count;
    uint32_t capacity; /* places there are; grows on the game thread up to max_surfaces */
    uint32_t max_surfaces;
    knurl_hip *hips;
    uint32_t hip_count;
    uint32_t committed;
};

/* Builds a surface from its description (surface.c). Errors: as knurl_scene_add_surface(). */
knurl_result knurl_surface_build(knurl_heap *heap, const knurl_surface_desc *desc, knurl_surface_data *surface);
void knurl_surface_release(knurl_heap *heap, knurl_surface_data *surface);

/* Checks a material and sets it, with all that follows from it. Errors: as knurl_scene_set_material(). */
knurl_result knurl_surface_set_material(knurl_surface_data *surface, const knurl_material_desc *desc);

/* A surface's tangent frame and coordinates at a contact, in its own frame (surface_frame.c). x, y: unit, tangent to
 * the contact's normal. coordinates: m, what S1 looks up. Allowed in a tick. */
void knurl_surface_frame(const knurl_surface_data *surface, const knurl_contact *contact, double x[3], double y[3],
                         double coordinates[2]) KNURL_NONBLOCKING;

/* Fills in what a HIP's description leaves open, as the loop and its device have it, and forgets what the HIP did.
 * Errors: KNURL_ERROR_ARGUMENT (another update rate was asked for). [game thread] */
knurl_result knurl_scene_adopt_device(knurl_scene *scene, uint32_t hip, double update_rate_hz, double resolution,
                                      double max_force);

/* The centre of all surfaces' bounds; 0 in an empty scene. */
void knurl_scene_centre(const knurl_scene *scene, double centre[3]);

/* The surface of an id, or null with an error. */
knurl_surface_data *knurl_scene_get(const knurl_scene *scene, knurl_surface surface);

#endif

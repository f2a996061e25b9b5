/* What a scene is made of. Edited under its lock, read by ticks without one: what a tick follows are atomic pointers to
 * things that never change once they can be seen (records, meshes, planes), and what an edit replaces is kept until no
 * tick can see it (retire.c). SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_SCENE_H
#define KNURL_SRC_SCENE_H

#include "base/handle.h"
#include "base/heap.h"
#include "base/seqlock.h"
#include "base/system.h"
#include "contact/bvh.h"
#include "contact/shape.h"
#include "scene/guard.h"
#include "scene/pose.h"

#include <knurl/scene.h>

/* Surfaces near a HIP that are looked at in a tick, at most. */
#define KNURL_MAX_NEAR 32

/* What an edit has replaced: the first member of everything that can be. */
typedef struct knurl_retired {
    struct knurl_retired *next;
    uint64_t epoch; /* ticks that began in this epoch or before may see it */
    void (*release)(knurl_heap *heap, struct knurl_retired *retired);
} knurl_retired;

/* How a surface feels and moves, from one edit to the next. Never changes once published. */
typedef struct knurl_record {
    knurl_retired retired;
    knurl_material_desc material; /* method resolved */
    double turn[2];               /* cosine and sine of the orientation */
    double reach;                 /* the highest crest: m in front of the surface where contact begins */
    int32_t has_grating;          /* 0: nothing to play, the stage is left out */
    int32_t is_smooth;            /* 1: neither ridges nor height */
    knurl_motion motion;          /* of the shape's frame */
    float arrived[6];             /* a box of where it is once the motion is over, with room; scene axes */
} knurl_record;

/* A surface. But for `record` and what edits keep for themselves it never changes. */
typedef struct knurl_surface_data {
    knurl_retired retired;
    knurl_record *record; /* atomic: the newest */
    knurl_shape shape;
    int32_t double_sided; /* 1: by its description or its shape */
    uint32_t place;
    uint32_t generation;
    uint32_t moved; /* edits: 1 once it was moved since the world was built */
    knurl_surface id;
    knurl_pose local; /* the shape's frame in the surface's */
    double axis[3];   /* unit, surface's frame; 0: none was given */
    char *name;
    const char *given; /* "plane" or "mesh" */
} knurl_surface_data;

/* Where all surfaces are, for finding those near a HIP: a hierarchy over those that stand still, and a list of those
 * that are loose: moved, or added, since it was built (world.c). */
typedef struct knurl_world {
    knurl_retired retired;
    knurl_surface_data **items; /* by place; atomic; null: nothing there */
    float (*boxes)[6];          /* by place: min and max in scene axes, reach included; atomic, may be seen half new */
    uint32_t *loose;            /* places; may name one that is empty by now */
    uint32_t *order;            /* places in the hierarchy's leaf order */
    knurl_bvh_node *nodes;
    uint32_t node_count;  /* 0: nothing stands still */
    uint32_t capacity;    /* places */
    uint32_t loose_count; /* atomic */
    uint8_t *is_loose;    /* by place; atomic: 0: it has stood still since the world was built */
} knurl_world;

/* One surface near a HIP. */
typedef struct knurl_near {
    uint32_t place;
    uint32_t generation;
    uint32_t in_contact;
    uint32_t asked;     /* 1: it was asked at the last tick, so that `previous` and `jumps` hold */
    uint64_t jumps;     /* the motion's, at the last tick */
    double previous[3]; /* the HIP at the last tick, shape's frame */
    knurl_contact_state contact;
    knurl_grating_state grating;
    knurl_guard_contact guard;
    double proxy[3]; /* of the latest contact, scene axes */
    double normal[3];
    float box[6];     /* scene axes; outside it there is nothing to ask */
    double anchor[3]; /* friction: where the HIP sticks, shape's frame */
} knurl_near;

/* What any thread may read of a HIP. */
typedef struct knurl_snapshot {
    knurl_tick_output output;
    knurl_hip_counts counts;
} knurl_snapshot;

/* What every tick reads comes first and close together: at 1 kHz it comes from a cold cache. */
typedef struct knurl_hip {
    uint64_t pinned; /* atomic: the epoch in which the tick that runs began; 0: none runs */
    double time;     /* atomic: s, scene time after the latest tick */
    double previous_time;
    double previous[3]; /* HIP position at the last tick, scene */
    double rate;
    double period;
    double quantum; /* m, scene: how far a position flickers at most that stands still: a count's diagonal */
    int32_t has_previous;
    int32_t is_turned;  /* 0: the workspace's rotation is 1, and is left out */
    double depth;       /* of the deepest contact at the latest tick, m; 0 without */
    double near_low[3]; /* the list below is complete while the HIP stays in this box, */
    double near_high[3];
    double near_depth; /* is pressed no deeper than this, and the scene's version stays */
    uint64_t version;  /* the scene's, when the list was made; 0: look again */
    uint32_t near_count;
    uint32_t near_overflow; /* 1: there were more than fit */
    double calm_at[3];      /* no farther than `calm` (m, each axis) from here, nothing but what is touched is met */
    double calm;
    knurl_workspace workspace;
    double left_time; /* s: when it slid off a surface; before 0: it did not, or another holds it */
    double left_proxy[3];
    double left_normal[3];
    knurl_guard guard;
    knurl_hip_counts counts;
    knurl_near near[KNURL_MAX_NEAR];
    KNURL_SEQLOCK(knurl_snapshot) published;
    knurl_velocity velocity;
    knurl_hip_desc given; /* as configured; what it leaves open a loop fills in */
    int32_t centred;      /* 1: the scene chooses the workspace at its commit */
} knurl_hip;

struct knurl_scene {
    uint32_t handle; /* KNURL_HANDLE_SCENE, first */
    /* read by ticks */
    uint32_t committed;
    knurl_world *world; /* atomic */
    uint64_t epoch;     /* atomic; from 1 */
    uint64_t version;   /* atomic; from 1: what near lists were made of has changed */
    knurl_hip *hips;
    uint32_t hip_count;
    uint32_t full_model;
    uint64_t apart[2]; /* what edits write begins in another cache line */

    /* for edits, under the lock */
    knurl_mutex *lock; /* who only reads takes it too */
    knurl_mutex mutexes[2];
    knurl_heap heap; /* under the second */
    knurl_retired *retired;
    knurl_surface_data **surfaces; /* by place; null: free */
    uint32_t *generations;         /* by place */
    uint32_t *order;               /* places of surfaces, in the order of adding */
    uint32_t *vacant;              /* places that are free, the next one last */
    uint32_t surface_count;
    uint32_t vacant_count;
    uint32_t capacity; /* of the four arrays; grows up to max_surfaces */
    uint32_t max_surfaces;
    uint64_t moves; /* since the world was built */
};

/* --- building (surface.c, record.c) --- */

/* Builds a surface with its record from its description. Errors: as knurl_scene_add_surface(). */
knurl_result knurl_surface_build(knurl_heap *heap, const knurl_surface_desc *desc, uint32_t full_model,
                                 knurl_surface_data **surface);
void knurl_surface_release(knurl_heap *heap, knurl_retired *surface);

/* Checks a material and sets it in a record, with all that follows from it. Errors: as knurl_scene_set_material(). */
knurl_result knurl_record_set_material(knurl_record *record, const knurl_surface_data *surface,
                                       const knurl_material_desc *desc, uint32_t full_model);

/* A copy to edit; null with an error. */
knurl_record *knurl_record_copy(knurl_heap *heap, const knurl_record *record);

/* Checks a pose and turns it into one of the surface's own frame. Errors: KNURL_ERROR_ARGUMENT. */
knurl_result knurl_surface_check_pose(const double position[3], const double rotation[4], knurl_pose *pose);

/* Scene bounds of all that a motion sweeps or, once it is over, of where it has arrived; without the reach. */
void knurl_surface_bounds(const knurl_surface_data *surface, const knurl_motion *motion, double time, double low[3],
                          double high[3]) KNURL_NONBLOCKING;

/* Sets the box of where a record's surface arrives, crests included, with `room` round it (world.c). */
void knurl_record_set_box(const knurl_surface_data *surface, knurl_record *record, double room);

/* --- edits that ticks may see (world.c, retire.c) --- */

/* Gives the scene a new world with room for `capacity` places. Errors: KNURL_ERROR_MEMORY. */
knurl_result knurl_world_rebuild(knurl_scene *scene, uint32_t capacity);

/* A surface has come to its place, or its record is about to be published: makes room in the world before, and takes
 * back after what is no longer needed. Errors: KNURL_ERROR_MEMORY. */
knurl_result knurl_world_add(knurl_scene *scene, knurl_surface_data *surface);
void knurl_world_publish(knurl_scene *scene, knurl_surface_data *surface, knurl_record *record);
void knurl_world_remove(knurl_scene *scene, knurl_surface_data *surface);

/* Gives something back once no tick can see it; it can no longer be reached. */
void knurl_scene_retire(knurl_scene *scene, knurl_retired *retired);

/* s: the time of the HIP that is ahead. */
double knurl_scene_time(const knurl_scene *scene);

/* --- in a tick --- */

/* Makes the HIP's list of near surfaces complete for a tick that takes it from its previous position to `position`
 * (near.c). */
void knurl_hip_look_around(const knurl_scene *scene, const knurl_world *world, knurl_hip *hip,
                           const double position[3]) KNURL_NONBLOCKING;

/* What to look for in a world. */
typedef struct knurl_view {
    const double *low; /* a box, scene axes, m */
    const double *high;
    double time;    /* s: what has arrived by then is where it is */
    int everything; /* 1: without the hierarchy */
    int exact;      /* 1: without the room round what moves */
} knurl_view;

/* Places of the surfaces that a view meets (world.c). At most `room` of them are written; returns how many there are,
 * at most room + 1. */
uint32_t knurl_world_find(const knurl_world *world, const knurl_view *view, uint32_t room,
                          uint32_t *places) KNURL_NONBLOCKING;

/* A surface's tangent frame at a contact, in the shape's frame (surface_frame.c). x, y: unit, tangent to the contact's
 * normal. coordinates: m, what S1 looks up. */
void knurl_surface_frame(const knurl_surface_data *surface, const knurl_record *record, const knurl_contact *contact,
                         double x[3], double y[3], double coordinates[2]) KNURL_NONBLOCKING;

/* How fast those coordinates change (m/s) where the HIP moves over the surface at `velocity` (m/s, shape's frame), and
 * by how much at most in a metre along the surface. 0, and untouched, where there are no coordinates. */
int knurl_surface_rates(const knurl_surface_data *surface, const knurl_record *record, const knurl_contact *contact,
                        const double velocity[3], double rates[2], double *steepest) KNURL_NONBLOCKING;

/* --- HIPs --- */

/* The Touch at 1 kHz: what a HIP's description and its device leave open. */
extern const knurl_hip_facts knurl_touch;

/* Fills in what a HIP's description leaves open, as the loop and its device have it, and forgets what the HIP did.
 * Errors: KNURL_ERROR_ARGUMENT (another update rate was asked for). [game thread] */
knurl_result knurl_scene_adopt_device(knurl_scene *scene, uint32_t hip, const knurl_hip_facts *facts);

/* The force (N) that the loop sent without a tick, at its end: the latest tick's is told to be this one. Where the
 * HIP's haptic thread is, or after it has ended (motors.c). */
void knurl_scene_tell_force(knurl_scene *scene, uint32_t hip, const double force[3],
                            const double device_force[3]) KNURL_NONBLOCKING;

/* The centre of all surfaces' bounds; 0 in an empty scene. */
void knurl_scene_centre(const knurl_scene *scene, double centre[3]);

/* The surface of an id, or null with an error. Under the lock. */
knurl_surface_data *knurl_scene_get(const knurl_scene *scene, knurl_surface surface);

void knurl_scene_lock(const knurl_scene *scene);
void knurl_scene_unlock(const knurl_scene *scene);

#endif

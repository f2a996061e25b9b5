/* The extension's surfaces and devices, and their links. Main thread only: a haptic thread uses the session's data.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_GODOT_WORLD_H
#define KNURL_GODOT_WORLD_H

#include "grating.h"
#include "session.h"

/* Devices that run at once; each has a bit in a surface's masks. */
enum { DEVICE_SLOTS = 8, ALL_SLOTS = 255 };

/* Frames to wait for the meshes of a node that builds its own, before it counts as empty. */
enum { TRIES = 10 };

typedef struct shape shape; /* see shapes.h */

/* A surface in a running device's scene, as it was last added or moved there. */
typedef struct surface_placement {
    shape *shape;                              /* or null: not shared */
    struct surface *next_user, *previous_user; /* of the shape */
    knurl_session_way way;
    float basis[3][3];    /* the node's */
    double quaternion[4]; /* from the basis: the rotation, */
    double rest[9];       /* and the scale that is baked in */
} surface_placement;

typedef struct surface {
    gd_instance base;
    gd_variant held; /* keeps the grating's reference */
    grating *grating;
    uint8_t double_sided, box_coordinates, enabled, reaction;
    int64_t smooth; /* KNURL_SMOOTH_ */
    int64_t layers; /* felt by devices that have one of them */
    float axis[3];
    struct surface *next_marked, **marked_at; /* the link that leads here; or null: not marked */
    struct surface *next, *previous;          /* of those in a tree */
    gd_variant watched;                       /* the mesh whose changes are followed, or nil */
    GDExtensionObjectPtr watched_parent;      /* the node whose changes are followed, or null */
    uint64_t meshes_seen;                     /* number of changes of its mesh */
    uint64_t explained;                       /* hash of the state that `explanation` was made for; 0: not made yet */
    char *explanation;   /* in the editor: its devices' warnings; in a game: why it is not felt; or null */
    uint8_t is_listed;   /* 1: among `surfaces` */
    uint8_t is_disabled; /* 1: its branch has the process mode DISABLED */
    uint8_t is_leaving;  /* 1: out of the tree since the last frame; it may come back at once */
    uint8_t is_dying;    /* 1: being freed */
    uint8_t moved, changed, made_anew;  /* masks: running devices that have not handled it yet */
    uint8_t tries;                      /* frames in which its parent had no triangles yet; stays at TRIES */
    uint8_t by_physics;                 /* 1: last moved by a physics step */
    uint8_t flat;                       /* mask: its scale is zero, so it is not in that device's scene */
    knurl_surface_id ids[DEVICE_SLOTS]; /* in each running device's scene, or 0 */
    surface_placement placements[DEVICE_SLOTS];
} surface;

typedef struct device {
    gd_instance base;
    struct device *next_placed; /* of those in a tree */
    char *uri, *stroke, *response;
    double rate, workspace_scale, gain;
    int64_t layers;
    float added_force[3]; /* N */
    uint8_t clutch, sound;
    uint8_t rumbles;        /* 1: the motors were set and have not been stopped */
    int64_t rumble;         /* gamepad whose motors play, or -1 */
    knurl_sound *rumble_of; /* or null */
    uint8_t moved,
        by_physics; /* moved: 1: its node or scale changed since the last frame; by_physics: 1: by a physics step */
    uint8_t autostart, reconnect, clamp, even;
    uint8_t wants_start; /* at the next frame */
    double retry;        /* s between attempts of a failed automatic start; 0: no further attempts */
    double retries_in;   /* s */
    uint8_t has_failed;  /* 1: the last automatic start failed, already reported */
    double impulse[3];   /* N s: of the haptic thread's forces, already applied to bodies */
    double ridges;       /* ridges already reported */
    uint8_t runs;
    uint8_t is_leaving;          /* 1: runs, out of the tree since this frame; it may come back at once */
    uint8_t paused, tree_paused; /* by the game; by the scene tree */
    int slot;                    /* -1: does not run */
    knurl_session *session;      /* or null: never started yet, and no file loaded */
    knurl_workspace workspace;
    knurl_surface_id touched;
    GDObjectInstanceID touched_node; /* the touched surface's, as reported; 0: from a file, or no contact */
    uint64_t gratings_seen;
    uint32_t failures;              /* surfaces that could not be added to its scene since the last report */
    double frames_time, steps_time; /* s: frames and physics steps so far, in real time */
    uint64_t steps_seen;
} device;

extern const gd_class surface_class;
extern const gd_class device_class;

/* Surfaces that are in a tree, or were at the last frame, in the order of entering. */
extern surface *surfaces;
void surface_list(surface *s);
void surface_unlist(surface *s);

/* Surfaces with changes that a running device may not have handled yet, linked by next_marked. Most surfaces do not
 * move and cost nothing. */
extern surface *marked_surfaces;
void surface_mark(surface *s);
void surface_unmark(surface *s);

/* Devices in a tree, running or not, by next_placed. */
extern device *placed_devices;

/* Running devices, or null. */
extern device *devices[DEVICE_SLOTS];

/* The device or surface of that instance id; null if it was freed. */
device *device_of(GDObjectInstanceID id);
surface *surface_of(GDObjectInstanceID id);

/* The node of a surface id in a running device's scene; null if the id is stale or from load_gltf(). */
surface *surface_in(const device *d, knurl_surface_id id);

#endif

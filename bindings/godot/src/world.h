/* Surfaces and devices as the extension knows them, and what they do to one another. Main thread only: what a haptic
 * thread sees is the session's. SPDX-License-Identifier: MIT */
#ifndef KNURL_GODOT_WORLD_H
#define KNURL_GODOT_WORLD_H

#include "grating.h"
#include "session.h"

/* Devices that run at once; each has a bit in a surface's masks. */
enum { DEVICE_SLOTS = 8, ALL_SLOTS = 255 };

typedef struct surface {
    gd_instance base;
    gd_variant held; /* keeps the grating's reference */
    grating *grating;
    uint8_t double_sided, enabled;
    float axis[3];
    struct surface *next_marked;
    uint8_t is_marked;
    struct surface *next, *previous;   /* of those in a tree */
    uint8_t moved, changed, made_anew; /* masks: which running device has yet to be told */
    uint8_t flat;                      /* mask: scaled to nothing, so not in that device's scene */
    knurl_surface ids[DEVICE_SLOTS];   /* in each running device's scene, or 0 */
    knurl_session_way ways[DEVICE_SLOTS];
    double rest[DEVICE_SLOTS][9]; /* scale that is baked in */
} surface;

typedef struct device {
    gd_instance base;
    char *uri, *stroke;
    double rate, workspace_scale;
    uint8_t autostart, reconnect, clamp;
    uint8_t wants_start; /* at the next frame */
    uint8_t runs;
    uint8_t paused, tree_paused; /* by the game; by the tree, as the engine tells */
    int slot;                    /* -1: does not run */
    knurl_session *session;      /* or null: never started yet, and no file loaded */
    knurl_workspace workspace;
    knurl_surface touched;
    GDExtensionObjectPtr touched_node; /* or null: a file's surface, or nothing */
    uint64_t gratings_seen;
} device;

extern const gd_class surface_class;
extern const gd_class device_class;

/* Those in a tree, in the order of entering. */
extern surface *surfaces;

/* Those of which some running device may have yet to be told something, by next_marked. Most surfaces stand still: they
 * are not even looked at. */
extern surface *marked_surfaces;
void surface_mark(surface *s);

/* Running devices, or null. */
extern device *devices[DEVICE_SLOTS];

/* follow.c: surfaces into a device's scene, along with their nodes, and out. Errors are pushed. */
void follow_add(device *d, surface *s);
void follow_remove(device *d, surface *s);
void follow_all(device *d);

/* Where a Node3D stands, in the world: 1, or 0 where it is scaled to nothing. */
int follow_pose(GDExtensionObjectPtr node, knurl_session_pose *pose);

/* Why a surface cannot be felt, a line each, in a caller's buffer; "" where it can. */
void follow_explain(const surface *s, char *text, size_t size);

/* device.c. start and stop: see KnurlDevice. */
int64_t device_start(device *d);
void device_stop(device *d);
void device_process(device *d);

/* Its parts: a session, if there is none yet; a slot, an opened session, all surfaces in its scene; and all of these
 * given back. After a failure device_release() is still to be called. */
knurl_result device_make_session(device *d);
knurl_result device_prepare(device *d);
void device_release(device *d);

/* Pushes knurl_error_message() as an error; the engine's Error of a result. */
int64_t device_fail(const char *where, knurl_result result);

/* signals.c: what happened since the last frame. */
void signals_tell(device *d);
void signals_let_go(device *d);

/* trace.c: KnurlDevice.play_trace(). */
void trace_play(void *self, const void *const *arguments, void *result);

/* status.c: KnurlDevice.get_status(). */
void status_tell(void *self, const void *const *arguments, void *result);

#endif

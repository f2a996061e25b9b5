/* A KnurlDevice's life: open, run, stop.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_GODOT_DEVICE_H
#define KNURL_GODOT_DEVICE_H

#include "world.h"

/* See KnurlDevice. */
int64_t device_start(device *d);
void device_stop(device *d);

/* Each frame, while the engine goes through its nodes: nothing is emitted. */
void device_process(device *d);

/* Each frame once it is through with them: what happened. A handler may free anything, so the device is known by its
 * instance id. */
void device_tell(GDObjectInstanceID id);

/* The node left the tree. It stops at the end of the frame, unless the node is back by then: put elsewhere in the tree,
 * the device goes on. */
void device_leave(device *d);

/* As device_stop(), and tells nothing. */
void device_end(device *d);

/* Its parts: a session, if there is none yet; a slot, an opened session, all surfaces in its scene; and all of these
 * given back. After a failure device_release() is still to be called. */
knurl_result device_make_session(device *d);
knurl_result device_prepare(device *d);
void device_release(device *d);

/* All surfaces as they are now into an opened session's scene, or out of it. */
void device_put_surfaces(device *d);

/* Where the node was moved or workspace_scale changed since the last call: the running workspace follows. */
void device_move_workspace(device *d);

/* Tells the session the property added_force. */
void device_apply_force(const device *d);

/* Plays the device's sound where the property sound says so. */
void device_apply_sound(const device *d);

/* Pushes knurl_error_message() as an error; the engine's Error of a result. */
int64_t device_fail(const char *where, knurl_result result);

#endif

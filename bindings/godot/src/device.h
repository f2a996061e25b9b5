/* A KnurlDevice's life: open, run, stop.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_GODOT_DEVICE_H
#define KNURL_GODOT_DEVICE_H

#include "world.h"

/* See KnurlDevice. */
int64_t device_start(device *d);
void device_stop(device *d);

/* Called each frame, while the engine processes its nodes: emits no signals. */
void device_process(device *d);

/* Called each frame after that: emits the signals. A handler may free any node, so the device is passed as an instance
 * id. */
void device_tell(GDObjectInstanceID id);

/* The node left the tree. It stops at the end of the frame, unless the node is back by then: a reparented device keeps
 * running. */
void device_leave(device *d);

/* Like device_stop(), but without signals. */
void device_end(device *d);

/* Steps of a start: make a session, if there is none yet; take a slot, open the session and add all surfaces; and undo
 * all of these. After a failure device_release() must still be called. */
knurl_result device_make_session(device *d);
knurl_result device_prepare(device *d);
void device_release(device *d);

/* Adds all surfaces in their present state to an opened session's scene, or removes them. */
void device_put_surfaces(device *d);

/* Updates the running workspace if the node moved or workspace_scale changed since the last call. */
void device_move_workspace(device *d);

/* Passes the property added_force to the session. */
void device_apply_force(const device *d);

/* Starts or stops the device's sound, by the property sound. */
void device_apply_sound(const device *d);

/* Logs knurl_error_message() as an error. Returns the engine's Error of a result. */
int64_t device_fail(const char *where, knurl_result result);

#endif

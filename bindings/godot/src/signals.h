/* Signals of a KnurlDevice and its surfaces. A handler may stop and start the device, remove and free nodes, or change
 * the scene. The engine crashes if this happens while it notifies, removes or frees a node, so signals are emitted from
 * its message queue, after all nodes of a frame were processed. Between two emissions only instance ids are kept.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_GODOT_SIGNALS_H
#define KNURL_GODOT_SIGNALS_H

#include "world.h"

/* The object that the message queue calls. tell_news: emits a device's events, if the device of that id still exists.
 */
extern const gd_class teller_class;
void signals_begin(void (*tell_news)(GDObjectInstanceID id));
void signals_end(void);

/* Schedules the signals of ended contacts and then, unless id is 0, of a device's events before this frame ends. */
void signals_tell_later(GDObjectInstanceID id);

/* A paused tree does not process the device's node, but its contacts end: until the pause ends, process_frame of the
 * tree drives the signals instead. */
void signals_tell_in_pause(const device *d);

/* The contact ended; the signal is emitted later. */
void signals_end_contact(device *d);

/* Emits the signals of ended contacts. */
void signals_tell_ends(void);

/* Emits the events since the last frame. Returns 1 if the session has ended; events after its end are still to be
 * emitted. */
int signals_tell(GDObjectInstanceID id);

/* Emits the number of ridges passed since the last call on the touched surface. ridges: the total so far. */
void signals_tell_ridges(device *d, double ridges);

/* Emits the failure of an automatic start. */
void signals_tell_failure(const device *d, int64_t error, const char *why);

#endif

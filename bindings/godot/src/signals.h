/* Signals of a KnurlDevice and its surfaces. A handler may do anything: stop and start the device, remove and free
 * nodes, change the scene. The engine does not survive that while it notifies, removes or frees a node. So nothing is
 * emitted then: the engine's message queue calls back once it is through with all nodes of a frame. From one emission
 * to the next only instance ids are kept. SPDX-License-Identifier: MIT */
#ifndef KNURL_GODOT_SIGNALS_H
#define KNURL_GODOT_SIGNALS_H

#include "world.h"

/* The object that the message queue calls. tell_news: tells a device's news, if there still is a device of that id. */
extern const gd_class teller_class;
void signals_begin(void (*tell_news)(GDObjectInstanceID id));
void signals_end(void);

/* Has the engine tell ended contacts and then, unless it is 0, a device's news, before this frame ends. */
void signals_tell_later(GDObjectInstanceID id);

/* A paused tree leaves the device's node out, but what is touched ends then: as long as it does, the frames of the tree
 * are told along instead. */
void signals_tell_in_pause(const device *d);

/* Nothing is touched any more, which is still to be told. */
void signals_end_contact(device *d);

/* Tells which contacts ended. */
void signals_tell_ends(void);

/* Tells what happened since the last frame. 1: the session has ended; events after its end are still to be told. */
int signals_tell(GDObjectInstanceID id);

/* Tells the surface that is touched how many ridges were passed since it was last told, of all that were so far. */
void signals_tell_ridges(device *d, double ridges);

/* A start of the device's own has failed. */
void signals_tell_failure(const device *d, int64_t error, const char *why);

#endif

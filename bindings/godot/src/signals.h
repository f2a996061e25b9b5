/* Signals of a KnurlDevice. Any of their handlers may stop the device, or start it again.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_GODOT_SIGNALS_H
#define KNURL_GODOT_SIGNALS_H

#include "world.h"

/* What happened since the last frame. 1: the session has ended; events after its end are still to be reported.
 */
int signals_tell(device *d);

/* Tells that nothing is touched any more. */
void signals_end_contact(device *d);

/* Tells the surface that is touched how many ridges were passed since it was last told, of all that were so far. */
void signals_tell_ridges(device *d, double ridges);

/* A start of the device's own has failed. */
void signals_tell_failure(const device *d, int64_t error, const char *why);

#endif

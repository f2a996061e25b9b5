/* Signals of a KnurlDevice. Any of their handlers may stop the device, or start it again.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_GODOT_SIGNALS_H
#define KNURL_GODOT_SIGNALS_H

#include "world.h"

/* What happened since the last frame. 1: the session has ended, and what else has happened since is still to be told.
 */
int signals_tell(device *d);

/* Tells that nothing is touched any more. */
void signals_end_contact(device *d);

#endif

/* KnurlDevice.play_trace().
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_GODOT_TRACE_H
#define KNURL_GODOT_TRACE_H

#include "world.h"

void trace_play(void *self, const void *const *arguments, void *result);

#endif

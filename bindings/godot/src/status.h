/* KnurlDevice.get_status().
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_GODOT_STATUS_H
#define KNURL_GODOT_STATUS_H

#include "world.h"

void status_tell(void *self, const void *const *arguments, void *result);

/* See KnurlDevice.list_devices(). */
void status_list(void *self, const void *const *arguments, void *result);

#endif

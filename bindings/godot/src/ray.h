/* KnurlDevice.cast_ray(): what a straight line goes through first. SPDX-License-Identifier: MIT */
#ifndef KNURL_GODOT_RAY_H
#define KNURL_GODOT_RAY_H

void ray_cast(void *self, const void *const *arguments, void *result);

#endif

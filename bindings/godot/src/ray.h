/* KnurlDevice.cast_ray(): the first hit of a line segment. SPDX-License-Identifier: MIT */
#ifndef KNURL_GODOT_RAY_H
#define KNURL_GODOT_RAY_H

void ray_cast(void *self, const void *const *arguments, void *result);

#endif

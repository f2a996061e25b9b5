/* Read-only properties of a KnurlDevice, as device_class.c lists them. self: a device; value, result: of the property's
 * type. SPDX-License-Identifier: MIT */
#ifndef KNURL_GODOT_DEVICE_STATE_H
#define KNURL_GODOT_DEVICE_STATE_H

void device_get_hip_position(void *self, void *value);
void device_get_proxy_position(void *self, void *value);
void device_get_force(void *self, void *value);
void device_get_running(void *self, void *value);
void device_get_in_contact(void *self, void *value);
void device_get_temporal_frequency(void *self, void *value);
void device_get_height(void *self, void *value);
void device_get_velocity(void *self, void *value);
void device_get_depth(void *self, void *value);
void device_get_buttons(void *self, void *value);
void device_get_stylus_rotation(void *self, void *value);
void device_get_touched(void *self, const void *const *arguments, void *result);
void device_get_device_name(void *self, void *value);
void device_get_ticks(void *self, void *value);
void device_get_overruns(void *self, void *value);

#endif

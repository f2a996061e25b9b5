/* Read-only properties of a KnurlDevice. SPDX-License-Identifier: MIT */
#include "device_state.h"
#include "device.h"

#include <string.h>

/* All zeros while nothing runs. */
static knurl_session_state look(const device *d) {
    knurl_session_state state;
    memset(&state, 0, sizeof state);
    if (d->runs) {
        knurl_session_get_state(d->session, &state);
    }
    return state;
}

static void give_vector(const double *from, void *to) {
    const float vector[3] = {(float)from[0], (float)from[1], (float)from[2]};
    memcpy(to, vector, sizeof vector);
}

/* Before the first tick, the HIP is at the workspace's origin. */
void device_get_hip_position(void *self, void *value) {
    const device *d = self;
    const knurl_session_state state = look(d);
    give_vector(state.ticks > 0 ? state.hip : d->workspace.origin, value);
}

void device_get_proxy_position(void *self, void *value) {
    const device *d = self;
    const knurl_session_state state = look(d);
    give_vector(state.ticks > 0 ? state.proxy : d->workspace.origin, value);
}

void device_get_force(void *self, void *value) {
    const knurl_session_state state = look(self);
    give_vector(state.force, value);
}

void device_get_running(void *self, void *value) {
    const device *d = self;
    *(uint8_t *)value = d->runs && !d->is_leaving;
}

void device_get_in_contact(void *self, void *value) {
    *(uint8_t *)value = look(self).in_contact != 0;
}

void device_get_temporal_frequency(void *self, void *value) {
    *(double *)value = look(self).temporal_frequency;
}

void device_get_height(void *self, void *value) {
    *(double *)value = look(self).height;
}

void device_get_velocity(void *self, void *value) {
    const knurl_session_state state = look(self);
    give_vector(state.velocity, value);
}

void device_get_depth(void *self, void *value) {
    *(double *)value = look(self).depth;
}

void device_get_buttons(void *self, void *value) {
    *(int64_t *)value = (int64_t)look(self).buttons;
}

/* The identity if the device does not measure it. */
void device_get_stylus_rotation(void *self, void *value) {
    const knurl_session_state state = look(self);
    const double *q = state.stylus;
    const int is_measured = q[0] != 0.0 || q[1] != 0.0 || q[2] != 0.0 || q[3] != 0.0;
    float rotation[4] = {0.0F, 0.0F, 0.0F, 1.0F};
    for (int i = 0; i < 4 && is_measured; i++) {
        rotation[i] = (float)q[i];
    }
    memcpy(value, rotation, sizeof rotation);
}

void device_get_touched(void *self, const void *const *arguments, void *result) {
    const device *d = self;
    (void)arguments;
    const surface *s = surface_of(d->touched_node);
    const GDExtensionObjectPtr object = s ? s->base.object : NULL;
    memcpy(result, &object, sizeof object);
}

void device_get_device_name(void *self, void *value) {
    const device *d = self;
    knurl_device_info info;
    knurl_device_info_init(&info, sizeof info);
    if (d->runs) {
        (void)knurl_device_get_info(knurl_session_get_device(d->session), &info);
    }
    gd_string_set(value, info.name);
}

void device_get_ticks(void *self, void *value) {
    *(int64_t *)value = (int64_t)look(self).ticks;
}

void device_get_overruns(void *self, void *value) {
    *(int64_t *)value = (int64_t)look(self).overruns;
}

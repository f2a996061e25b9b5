/* KnurlDevice.cast_ray(): the first hit of a line segment. SPDX-License-Identifier: MIT */
#include "ray.h"

#include "device.h"

#include <string.h>

static void set_vector(void *dictionary, const char *key, const double value[3]) {
    const float vector[3] = {(float)value[0], (float)value[1], (float)value[2]};
    gd_dictionary_set(dictionary, key, GDEXTENSION_VARIANT_TYPE_VECTOR3, vector);
}

void ray_cast(void *self, const void *const *arguments, void *result) {
    const device *d = self;
    const float *ends[2] = {arguments[0], arguments[1]};
    double line[2][3];
    knurl_surface_point hit;
    knurl_surface_point_init(&hit, sizeof hit);
    for (int i = 0; i < 6; i++) {
        line[i / 3][i % 3] = (double)ends[i / 3][i % 3];
    }
    const knurl_result failed =
        d->runs ? knurl_scene_cast_ray(knurl_session_get_scene(d->session), line[0], line[1], &hit) : KNURL_OK;
    if (failed) {
        (void)device_fail("KnurlDevice.cast_ray", failed);
    } else if (hit.surface) {
        const surface *s = surface_in(d, hit.surface);
        const GDExtensionObjectPtr node = s ? s->base.object : NULL;
        set_vector(result, "position", hit.position);
        set_vector(result, "normal", hit.normal);
        gd_dictionary_set(result, "distance", GDEXTENSION_VARIANT_TYPE_FLOAT, &hit.distance);
        gd_dictionary_set(result, "surface", GDEXTENSION_VARIANT_TYPE_OBJECT, &node);
    }
}

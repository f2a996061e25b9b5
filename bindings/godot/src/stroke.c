/* Strokes of the fake device's hand, in scene coordinates. SPDX-License-Identifier: MIT */
#include "world.h"

#include <math.h>

/* How far a device position can go along +-direction before it leaves the workspace; 0 outside. */
static double room(const knurl_device_info *limits, const double from[3], const double direction[3]) {
    double reach = HUGE_VAL;
    for (int axis = 0; axis < 3; axis++) {
        const double space = fmin(limits->workspace_max[axis] - from[axis], from[axis] - limits->workspace_min[axis]);
        if (fabs(direction[axis]) > 1e-6) {
            reach = fmin(reach, fmax(0.0, space) / fabs(direction[axis]));
        }
    }
    return reach;
}

static knurl_result lay_over(const device *d, knurl_surface id, knurl_stroke_desc *stroke) {
    knurl_surface_info info;
    knurl_device_info limits;
    double y[3];
    knurl_surface_info_init(&info, sizeof info);
    knurl_device_info_init(&limits, sizeof limits);
    knurl_result result = knurl_scene_surface_info(d->scene, id, &info);
    result = result ? result : knurl_device_get_info(d->device, &limits);
    if (result) {
        return result;
    }
    knurl_workspace_to_device(&d->workspace, info.anchor, stroke->centre);
    knurl_workspace_vector_to_device(&d->workspace, info.anchor_x, stroke->x);
    knurl_workspace_vector_to_device(&d->workspace, info.anchor_normal, stroke->normal);
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3;
        const int k = (i + 2) % 3;
        y[i] = stroke->normal[j] * stroke->x[k] - stroke->normal[k] * stroke->x[j];
    }
    const double *edge = info.anchor_reach;
    const double scale = d->workspace.scale;
    const double reach[2] = {fmin(edge[0], edge[1]) / scale, fmin(edge[2], edge[3]) / scale};
    stroke->reach[0] = fmin(1.0, fmax(1e-4, 0.9 * fmin(reach[0], room(&limits, stroke->centre, stroke->x))));
    stroke->reach[1] = fmin(1.0, fmax(1e-4, 0.9 * fmin(reach[1], room(&limits, stroke->centre, y))));
    if (room(&limits, stroke->centre, stroke->normal) < 0.01) { /* a stroke starts 5 mm above the surface */
        gd_warning("KnurlDevice.start",
                   "KnurlDevice: surface '%s' lies outside of the workspace, so the stroke over "
                   "it is cut short: move the KnurlDevice to it",
                   info.name);
    }
    return KNURL_OK;
}

/* Without a stroke the hand stands still at the workspace's origin. */
knurl_result stroke_lay(device *d) {
    knurl_stroke_desc stroke;
    knurl_stroke_desc_init(&stroke, sizeof stroke);
    knurl_result result = KNURL_OK;
    if (d->stroke && d->stroke[0]) {
        const knurl_surface first = knurl_scene_surface_at(d->scene, 0);
        result = knurl_stroke_from_name(d->stroke, &stroke.stroke);
        result = result || !first ? result : lay_over(d, first, &stroke);
    } else {
        stroke.stroke = KNURL_STROKE_REST;
        stroke.depth = 0.0;
    }
    return result ? result : knurl_fake_set_stroke(d->device, &stroke);
}

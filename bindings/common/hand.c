/* Strokes of the fake device's hand, in scene coordinates. SPDX-License-Identifier: MIT */
#include "parts.h"

#include <math.h>

/* m: a stroke starts 5 mm above the surface, and wants some room. */
#define ROOM 0.01

/* How far a device position can go along +-direction before it leaves the workspace; 0 outside. */
static double room(const knurl_device_info *limits, const double from[3], const double direction[3]) {
    double reach = HUGE_VAL;
    for (int axis = 0; axis < 3; axis++) {
        const double space = fmin(limits->workspace_max[axis] - from[axis], from[axis] - limits->workspace_min[axis]);
        if (space <= 0.0) {
            return 0.0;
        }
        if (fabs(direction[axis]) > 1e-6) {
            reach = fmin(reach, space / fabs(direction[axis]));
        }
    }
    return reach;
}

static knurl_result lay_over(const knurl_session *s, knurl_surface id, knurl_stroke_desc *stroke, int *is_outside) {
    knurl_surface_info info;
    knurl_device_info limits;
    double y[3];
    knurl_surface_info_init(&info, sizeof info);
    knurl_device_info_init(&limits, sizeof limits);
    knurl_result result = knurl_scene_surface_info(s->scene, id, &info);
    result = result ? result : knurl_device_get_info(s->device, &limits);
    if (result) {
        return result;
    }
    const knurl_workspace *workspace = &s->desc.workspace;
    knurl_workspace_to_device(workspace, info.anchor, stroke->centre);
    knurl_workspace_vector_to_device(workspace, info.anchor_x, stroke->x);
    knurl_workspace_vector_to_device(workspace, info.anchor_normal, stroke->normal);
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3;
        const int k = (i + 2) % 3;
        y[i] = stroke->normal[j] * stroke->x[k] - stroke->normal[k] * stroke->x[j];
    }
    const double *edge = info.anchor_reach;
    const double scale = workspace->scale;
    const double reach[2] = {fmin(edge[0], edge[1]) / scale, fmin(edge[2], edge[3]) / scale};
    stroke->reach[0] = fmin(1.0, fmax(1e-4, 0.9 * fmin(reach[0], room(&limits, stroke->centre, stroke->x))));
    stroke->reach[1] = fmin(1.0, fmax(1e-4, 0.9 * fmin(reach[1], room(&limits, stroke->centre, y))));
    *is_outside = room(&limits, stroke->centre, stroke->normal) < ROOM;
    return KNURL_OK;
}

/* Without a stroke the hand stands still at the workspace's origin. */
knurl_result knurl_session_lay_stroke(const knurl_session *session, knurl_surface *outside) {
    knurl_stroke_desc stroke;
    knurl_stroke_desc_init(&stroke, sizeof stroke);
    const knurl_surface first = knurl_scene_surface_at(session->scene, 0);
    knurl_result result = KNURL_OK;
    int is_outside = 0;
    if (session->stroke) {
        stroke.stroke = session->stroke;
        result = first ? lay_over(session, first, &stroke, &is_outside) : KNURL_OK;
    } else {
        stroke.stroke = KNURL_STROKE_REST;
        stroke.depth = 0.0;
    }
    result = result ? result : knurl_fake_set_stroke(session->device, &stroke);
    if (!result && is_outside) {
        *outside = first;
    }
    return result;
}

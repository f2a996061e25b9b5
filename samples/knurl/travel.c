/* The distance that a run moved in contact. SPDX-License-Identifier: MIT */
#include "travel.h"

#include <math.h>

#define JUDGED_S 1.0   /* a stroke takes 0.25 s to reach the surface */
#define SOME_MM  0.005 /* m: a shorter distance is not a stroke */

void travel_add(travel *t, const knurl_tick_output *output) {
    const double *v = output->surface_velocity;
    if (output->flags & KNURL_TICK_CONTACT) {
        t->metres += t->period * sqrt(v[0] * v[0] + v[1] * v[1]);
    }
}

static int is_moving(int32_t stroke) {
    return stroke == KNURL_STROKE_LINE || stroke == KNURL_STROKE_SWEEP || stroke == KNURL_STROKE_CIRCLE;
}

int travel_check(const travel *t, const knurl_scene *scene, knurl_surface_id surface, double seconds) {
    knurl_hip_counts counts;
    char name[KNURL_NAME_SIZE];
    knurl_material_desc material;
    knurl_material_desc_init(&material, sizeof material);
    if ((t->stroke && seconds < JUDGED_S) || knurl_scene_get_tick(scene, 0, NULL, &counts) ||
        knurl_scene_get_surface_name(scene, surface, name) || knurl_scene_get_material(scene, surface, &material)) {
        return TOOL_OK;
    }
    if (counts.contact_ticks == 0) {
        return tool_error(TOOL_NO_CONTACT,
                          "run: nothing was touched in %.3g s: 'knurl inspect' lists which surfaces are in reach, and "
                          "which way they face",
                          seconds);
    }
    const double *fs = material.spatial_frequency;
    const double least = fmax(SOME_MM, fs[0] > 0.0 ? 1.0 / fs[0] : 0.0);
    if (is_moving(t->stroke) && (t->metres < least || t->stroke_length < 0.001)) {
        return tool_error(TOOL_NO_CONTACT,
                          "run: the stroke over '%s' is %.2g mm long and moved %.2g mm in contact, expected %.2g mm or "
                          "more: the surface is too small for it, or leaves the workspace where it begins",
                          name, 1e3 * t->stroke_length, 1e3 * t->metres, 1e3 * least);
    }
    return TOOL_OK;
}

/* The places of ridges on any model, for drawing them: the grating's coordinates at points of its surfaces.
 * SPDX-License-Identifier: MIT */
#include "web.h"

#include <knurl/hip.h>
#include <knurl/query.h>

#include <emscripten.h>
#include <math.h>
#include <string.h>

static knurl_scene *survey; /* a copy of the scene with one cycle per metre, whose cycles are the coordinates */

/* Begins: loads the same file. */
EMSCRIPTEN_KEEPALIVE int web_survey(const void *data, uint32_t size, const char *name) {
    knurl_result result = web_read(data, size, name, &survey);
    const uint32_t count = result ? 0 : knurl_scene_get_surface_count(survey);
    for (uint32_t i = 0; i < count && !result; i++) {
        const knurl_surface_id surface = knurl_scene_get_surface(survey, i);
        knurl_material_desc m;
        knurl_material_desc_init(&m, sizeof m);
        result = knurl_scene_get_material(survey, surface, &m);
        m.spatial_frequency[0] = m.spatial_frequency[1] = 1.0;
        m.amplitude = 1e-6; /* 0 would be no grating */
        m.method = KNURL_METHOD_S1;
        result = result ? result : knurl_scene_set_material(survey, surface, &m);
    }
    knurl_hip_desc desc;
    knurl_workspace workspace;
    knurl_hip_desc_init(&desc, sizeof desc);
    knurl_workspace_set_identity(&workspace);
    desc.workspace = &workspace;
    desc.resolution = 0.0;
    desc.protections = 0;
    return result ? result : knurl_scene_configure_hip(survey, 0, &desc);
}

/* points: a point (3) on a surface and its normal (3) each, `depth` m deep at most. found: its coordinates u and v, m,
 * and its surface's index, or -1: each point is touched from above. */
EMSCRIPTEN_KEEPALIVE void web_coordinates(uint32_t count, const double *points, double depth, float *found) {
    static const double steps[3] = {NAN, 1.0, -1.0}; /* lift, then through the surface */
    for (uint32_t k = 0; k < count; k++) {
        knurl_tick_output out;
        memset(&out, 0, sizeof out);
        for (int step = 0; step < 3; step++) {
            knurl_tick_input in;
            memset(&in, 0, sizeof in);
            in.absent = step == 0;
            for (int i = 0; i < 3 && step > 0; i++) {
                in.position[i] = points[6 * k + i] + steps[step] * depth * points[6 * k + 3 + i];
            }
            (void)knurl_scene_tick(survey, 0, &in, &out);
        }
        found[3 * k] = (float)out.cycles[0];
        found[3 * k + 1] = (float)out.cycles[1];
        found[3 * k + 2] = out.flags & KNURL_TICK_CONTACT ? (float)web_find_index(survey, out.surface) : -1.0F;
    }
}

EMSCRIPTEN_KEEPALIVE void web_survey_end(void) {
    knurl_scene_destroy(survey);
    survey = NULL;
}

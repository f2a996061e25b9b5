/* Strokes of the fake device's hand. SPDX-License-Identifier: MIT */
#include "parts.h"

/* Without a stroke the hand stands still at the workspace's origin. */
knurl_result knurl_session_lay_stroke(const knurl_session *session, knurl_surface_id *outside) {
    const knurl_surface_id first = knurl_scene_get_surface(session->scene, 0);
    if (session->stroke && first) {
        knurl_stroke_report report;
        knurl_stroke_report_init(&report, sizeof report);
        const knurl_result result =
            knurl_fake_lay_stroke(session->device, session->scene, 0, first, session->stroke, &report);
        if (!result && report.is_outside) {
            *outside = first;
        }
        return result;
    }
    knurl_stroke_desc stroke;
    knurl_stroke_desc_init(&stroke, sizeof stroke);
    stroke.stroke = session->stroke;
    if (!session->stroke) {
        stroke.stroke = KNURL_STROKE_REST;
        stroke.depth = 0.0;
    }
    return knurl_fake_set_stroke(session->device, &stroke);
}

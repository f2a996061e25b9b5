/* Knurl: plans strokes of the fake device's hand over the surfaces of a scene.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_STROKE_H
#define KNURL_STROKE_H

#include <knurl/fake.h>
#include <knurl/scene.h>

#ifdef __cplusplus
extern "C" {
#endif

/** The result of knurl_fake_lay_stroke(). An output: set struct_size with knurl_stroke_report_init() first. */
typedef struct knurl_stroke_report {
    uint32_t struct_size;
    uint32_t is_outside; /**< 1: the surface's anchor is outside the device's workspace, so the stroke is shortened */
    uint32_t follows;    /**< 1: a path over a curved surface; 0: a straight stroke */
    uint32_t reserved;   /**< 0 */
    double length;       /**< m, device: LINE and SWEEP from end to end, CIRCLE once round; else 0 */
} knurl_stroke_report;

/** Sets struct_size; `size` is the caller's sizeof. [any thread] */
KNURL_API void knurl_stroke_report_init(knurl_stroke_report *report, uint32_t size);

/** Plans a stroke of the fake device's hand over a surface, 1 mm below it, within a HIP's workspace. It has an effect
 * from the next knurl_device_start() on. Takes some milliseconds.
 *
 * LINE and SWEEP follow the surface's x from its anchor (knurl_surface_info), over nine tenths of the distance to the
 * point where the surface or the workspace ends, the surface bends by more than 60 degrees within a step of at most 0.5
 * mm, or the line closes. If lines along x are small rings, as near a pole, the stroke starts further away. CIRCLE goes
 * round the anchor. For a moving surface, its current pose is used.
 *
 * stroke: KNURL_STROKE_. report: may be null. Errors: KNURL_ERROR_STALE_ID, KNURL_ERROR_UNSUPPORTED (not a fake
 * device), KNURL_ERROR_ARGUMENT (hip, stroke), KNURL_ERROR_STATE (the scene is to choose the workspace, and is not
 * committed), KNURL_ERROR_MEMORY. [game thread] */
KNURL_API knurl_result knurl_fake_lay_stroke(knurl_device *device, const knurl_scene *scene, uint32_t hip,
                                             knurl_surface_id surface, int32_t stroke, knurl_stroke_report *report);

#ifdef __cplusplus
}
#endif
#endif

/* A surface's material and motion, immutable from one edit to the next. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_RECORD_H
#define KNURL_SRC_RECORD_H

#include "contact/shape.h"
#include "grating/method.h"
#include "surface/epoch.h"
#include "surface/pose.h"

#include <knurl/scene.h>

/* Reductions to switch off: knurl_scene_desc.full_model does so with all, tests with one at a time. */
enum {
    KNURL_FULL_MESHES = 1,  /* flat meshes stay meshes, instead of planes with an outline */
    KNURL_FULL_SEARCH = 2,  /* every tick tests all surfaces, instead of nearby ones */
    KNURL_FULL_GRATING = 4, /* smooth surfaces run the grating stage, instead of skipping it */
    KNURL_FULL_ALL = 7
};

/* Immutable once published: an edit publishes another one. */
typedef struct knurl_record {
    knurl_retired retired;
    uint64_t edits;               /* of the surface, from 1 to this record: unlike an address, never used again */
    knurl_material_desc material; /* method resolved */
    const knurl_method *method;   /* its row */
    double cos_sin[2];            /* of the orientation */
    double amplitude;             /* m: the material's; 0 if both of its frequencies are 0 */
    double crest;                 /* m: height of the highest crest */
    double reach;        /* m in front of the shape at which contact begins: the crest, and the shape's bulge */
    int32_t has_grating; /* 0: nothing to play, the grating stage is skipped */
    int32_t is_oriented; /* 0: the orientation is 0, and is skipped */
    knurl_motion motion; /* of the shape's frame */
    float arrived[6];    /* box after the motion, with a margin; scene axes */
    float moving_box[6]; /* scene axes, crests included: bounds the whole motion */
    float end_box[6];    /* the same after the motion */
} knurl_record;

/* The box of a record's surface from `time` (s) on. Allowed in a tick. */
static inline const float *knurl_record_box(const knurl_record *record, double time) {
    return knurl_motion_is_over(&record->motion, time) ? record->end_box : record->moving_box;
}

/* Checks a material and sets it in a record, with the values derived from it and from the surface's shape. Errors: as
 * knurl_scene_set_material(). */
knurl_result knurl_record_set_material(knurl_record *record, const knurl_shape *shape, const knurl_material_desc *desc,
                                       uint32_t full_model);

/* A copy to edit, or an empty record if `record` is null. Returns null, with an error, if out of memory. */
knurl_record *knurl_record_copy(knurl_heap *heap, const knurl_record *record);

#endif

/* A surface: its shape, its description, and its current material and motion. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_SURFACE_H
#define KNURL_SRC_SURFACE_H

#include "contact/shape.h"
#include "surface/record.h"

/* Immutable once published, except `record` and `moved`. */
typedef struct knurl_surface_data {
    knurl_retired retired;
    knurl_record *record; /* atomic: the current one */
    knurl_shape shape;
    int32_t double_sided; /* 1: set by its description or by its shape */
    uint32_t place;       /* index among the scene's surfaces */
    uint32_t generation;
    uint32_t moved; /* for edits: 1 if moved since the broad phase's index was built */
    knurl_surface_id id;
    knurl_pose local; /* the shape's frame in the surface's */
    double radius;    /* m: the shape's farthest corner from the surface's origin */
    double axis[3];   /* unit, surface's frame; 0: no axis */
    char *name;
    const char *given; /* "plane" or "mesh" */
} knurl_surface_data;

/* A shape to be shared with another surface, with its frame and axis. */
typedef struct knurl_shared_shape {
    knurl_shape shape;
    knurl_pose local;
    double axis[3];
    const char *given;
} knurl_shared_shape;

/* Takes a reference to the shape, which knurl_surface_build() consumes. */
void knurl_surface_share(const knurl_surface_data *surface, knurl_shared_shape *shared);

/* Builds a surface with its record from a complete description (knurl_desc_read()). shared: the shape of `shape_of`, or
 * null; its reference is consumed, also on failure. Errors: as knurl_scene_add_surface(). */
knurl_result knurl_surface_build(knurl_heap *heap, const knurl_surface_desc *desc, uint32_t full_model,
                                 const knurl_shared_shape *shared, knurl_surface_data **surface);
void knurl_surface_release(knurl_heap *heap, knurl_retired *surface);

/* Checks a pose and converts it to the surface's own frame. Errors: KNURL_ERROR_ARGUMENT. */
knurl_result knurl_surface_check_pose(const double position[3], const double rotation[4], knurl_pose *pose);

/* Scene bounds of a whole motion or, once it is over, of its end; without the reach. */
void knurl_surface_bounds(const knurl_surface_data *surface, const knurl_motion *motion, double time, double low[3],
                          double high[3]) KNURL_NONBLOCKING;

/* The same for a record's motion, with its crests and `margin` (m) around it, rounded outwards: min and max. */
void knurl_surface_box(const knurl_surface_data *surface, const knurl_record *record, double time, double margin,
                       float box[6]) KNURL_NONBLOCKING;

/* Sets a record's boxes except `arrived`, after its motion or its reach has changed. */
void knurl_surface_set_boxes(const knurl_surface_data *surface, knurl_record *record);

/* Sets a record's `arrived` box, with `margin` (m) around it. */
void knurl_surface_set_arrival(const knurl_surface_data *surface, knurl_record *record, double margin);

#endif

/* A shape in its own frame: a bounded plane or a triangle mesh, chosen at creation. Immutable once created.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_SHAPE_H
#define KNURL_SRC_SHAPE_H

#include "base/heap.h"
#include "contact/mesh_cast.h"
#include "contact/mesh_contact.h"
#include "contact/mesh_frame.h"
#include "contact/plane_hold.h"

#include <knurl/contact.h>

typedef struct knurl_shape {
    knurl_plane *plane; /* one of these, the other is null */
    knurl_mesh *mesh;
    double low[3], high[3]; /* bounds, m */
    double seam;            /* m: beyond its edges that a cast still hits */
    double bulge;           /* m: greatest distance of the felt surface from a smooth mesh's triangles; 0: felt as is */
    int32_t has_coordinates, is_projected; /* 1: there are positions on the grating; 1: projected, with jumps */
    int32_t double_sided, has_flat_uvs;    /* 1: every triangle has two sides; 1: projected, for its uvs have no area */
    int32_t smooth;                        /* KNURL_SMOOTH_ */
    const char *model, *why, *coordinates; /* static, of knurl_surface_info */
} knurl_shape;

/* Description of a shape to create. */
typedef struct knurl_shape_desc {
    const knurl_plane_desc *plane; /* exactly one of plane and mesh is set */
    const knurl_mesh_desc *mesh;
    const double *axis; /* unit, in the frame of the plane or mesh: the grating's x; null: tangents, else uvs */
    int32_t is_box, full_model, smooth; /* 1: projected, without an axis; 1: a flat mesh stays a mesh; KNURL_SMOOTH_ */
} knurl_shape_desc;

/* Creates a shape. position, rotation (row-major): its own frame, in the frame of the given plane or mesh. Errors:
 * KNURL_ERROR_ARGUMENT (field, index, expected, found), KNURL_ERROR_MEMORY; *shape has no plane or mesh then. */
knurl_result knurl_shape_create(knurl_heap *heap, const knurl_shape_desc *desc, knurl_shape *shape, double position[3],
                                double rotation[9]);

/* Another shape with the same plane or mesh: a copy of the struct. Destroy each. [any thread] */
knurl_shape knurl_shape_share(const knurl_shape *shape);

/* Atomic: number of shapes that share this plane or mesh, without the first. */
static inline uint32_t *knurl_shape_other_users(const knurl_shape *shape) {
    return shape->plane ? &shape->plane->other_users : &shape->mesh->other_users;
}

/* The last shape that shares a plane or a mesh frees it. A zeroed shape is allowed. [any thread] */
void knurl_shape_destroy(knurl_heap *heap, const knurl_shape *shape);

/* Returns 1 and a contact while the HIP is inside, on the surface (KNURL_ON_SURFACE) or within reach, else 0 and a
 * zeroed state. Allowed in a tick. */
static inline int knurl_shape_contact(const knurl_shape *shape, const knurl_contact_query *query,
                                      knurl_contact_state *state, knurl_contact *contact) KNURL_NONBLOCKING {
    return shape->plane ? knurl_plane_contact(shape->plane, query, state, contact)
                        : knurl_mesh_contact(shape->mesh, query, state, contact);
}

/* Returns 1 and the first hit of a segment. Allowed in a tick. */
static inline int knurl_shape_cast(const knurl_shape *shape, const knurl_cast *cast,
                                   knurl_cast_hit *hit) KNURL_NONBLOCKING {
    return shape->plane ? knurl_plane_cast(shape->plane, cast, hit) : knurl_mesh_cast(shape->mesh, cast, hit);
}

/* Sets state and contact at a point of the face that was hit, except normal and z. Allowed in a tick. */
static inline void knurl_shape_rest(const knurl_shape *shape, const knurl_cast_hit *hit, const double point[3],
                                    knurl_contact_state *state, knurl_contact *contact) KNURL_NONBLOCKING {
    if (shape->plane) {
        knurl_plane_rest(hit, point, state, contact);
    } else {
        knurl_mesh_rest(shape->mesh, hit, point, state, contact);
    }
}

/* Tangent frame at a contact (x, y: unit, tangent to the contact's normal, y = n x x), and a mesh's coordinates (m; for
 * a plane use knurl_plane_coordinates(), which a smooth one does not need). Allowed in a tick. */
static inline void knurl_shape_frame(const knurl_shape *shape, const knurl_contact *contact, double x[3], double y[3],
                                     double coordinates[2]) KNURL_NONBLOCKING {
    if (shape->plane) {
        knurl_plane_axes(shape->plane, contact, x, y);
    } else {
        knurl_mesh_frame(shape->mesh, contact, x, y, coordinates);
    }
}

/* Rates of change of those coordinates (m/s) at a velocity of the HIP (m/s). Returns 0 if there are no coordinates: do
 * not use the outputs then. Allowed in a tick. */
static inline int knurl_shape_rates(const knurl_shape *shape, const knurl_contact *contact, const double velocity[3],
                                    double rates[2]) KNURL_NONBLOCKING {
    return shape->plane ? knurl_plane_rates(shape->plane, contact, velocity, rates)
                        : knurl_mesh_rates(shape->mesh, contact, velocity, rates);
}

/* Start of a stroke, as a zeroed contact with proxy, normal, weights and triangle set: on a mesh, the face that a hand
 * would meet first. rotation (row-major): from the shape's axes to the scene's. */
void knurl_shape_anchor(const knurl_shape *shape, const double rotation[9], knurl_contact *anchor);

/* Triangles kept of a mesh; 0: given as a plane. */
static inline uint32_t knurl_shape_triangles(const knurl_shape *shape) {
    return shape->plane ? shape->plane->triangle_count : shape->mesh->triangle_count;
}

static inline const knurl_shape_facts *knurl_shape_get_facts(const knurl_shape *shape) {
    return shape->plane ? &shape->plane->facts : &shape->mesh->facts;
}

#endif

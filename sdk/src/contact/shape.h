/* A shape in its own frame: a bounded plane or a triangle mesh. The kind is chosen at creation and called through a
 * table of functions. Immutable once created. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_SHAPE_H
#define KNURL_SRC_SHAPE_H

#include "base/heap.h"
#include "contact/mesh_frame.h"
#include "contact/plane_hold.h"
#include "contact/shape_facts.h"

#include <knurl/contact.h>

/* Functions of one kind of shape; geometry: its own data. Described at knurl_shape_contact() and below. */
typedef struct knurl_shape_functions {
    int (*contact)(const void *geometry, const knurl_contact_query *query, knurl_contact_state *state,
                   knurl_contact *contact) KNURL_NONBLOCKING;
    int (*cast)(const void *geometry, const knurl_cast *cast, knurl_cast_hit *hit) KNURL_NONBLOCKING;
    void (*rest)(const void *geometry, const knurl_cast_hit *hit, const double point[3], knurl_contact_state *state,
                 knurl_contact *contact) KNURL_NONBLOCKING;
    void (*anchor)(const void *geometry, const double rotation[9], knurl_contact *anchor);
    void (*facts)(const void *geometry, knurl_shape_facts *facts);
    /* 1 if contact can meet a tick's limit of visits; reach: m, of the crests */
    int (*exceeds_visits)(const void *geometry, double reach, uint32_t max_visits);
    uint32_t *(*other_users)(void *geometry); /* atomic */
    void (*destroy)(knurl_heap *heap, void *geometry);
} knurl_shape_functions;

typedef struct knurl_shape {
    const knurl_shape_functions *functions;
    void *geometry;           /* passed to the functions */
    const knurl_plane *plane; /* the geometry if it is a plane, else null: a direct call is faster */
    double low[3], high[3];   /* bounds, m */
    double seam;              /* m: beyond its edges that a cast still hits */
    double bulge; /* m: greatest distance of the felt surface from a smooth mesh's triangles; 0: felt as is */
    int32_t has_coordinates, is_projected; /* 1: there are positions on the grating; 1: projected, with jumps */
    int32_t double_sided, has_flat_uvs;    /* 1: every triangle has two sides; 1: projected, for its uvs have no area */
    int32_t smooth;                        /* KNURL_SMOOTH_ */
    const char *why, *coordinates;         /* static, of knurl_surface_info */
} knurl_shape;

/* Description of a shape to create. */
typedef struct knurl_shape_desc {
    const knurl_plane_desc *plane; /* exactly one of plane and mesh is set */
    const knurl_mesh_desc *mesh;
    const double *axis; /* unit, in the frame of the plane or mesh: the grating's x; null: tangents, else uvs */
    int32_t is_box, full_model, smooth; /* 1: projected, without an axis; 1: a flat mesh stays a mesh; KNURL_SMOOTH_ */
} knurl_shape_desc;

/* Creates a shape. position, rotation (row-major): its own frame, in the frame of the given plane or mesh. Errors:
 * KNURL_ERROR_ARGUMENT (field, index, expected, found), KNURL_ERROR_MEMORY; *shape has no geometry then. */
knurl_result knurl_shape_create(knurl_heap *heap, const knurl_shape_desc *desc, knurl_shape *shape, double position[3],
                                double rotation[9]);

/* Another shape with the same geometry: a copy of the struct. Destroy each. [any thread] */
knurl_shape knurl_shape_share(const knurl_shape *shape);

/* Number of shapes that share this geometry, including this one. */
static inline uint32_t knurl_shape_users(const knurl_shape *shape) {
    return 1 + __atomic_load_n(shape->functions->other_users(shape->geometry), __ATOMIC_RELAXED);
}

/* The last shape that shares a geometry frees it. A zeroed shape is allowed. [any thread] */
void knurl_shape_destroy(knurl_heap *heap, const knurl_shape *shape);

/* Returns 1 and a contact while the HIP is inside, on the surface (KNURL_ON_SURFACE) or within reach, else 0 and a
 * zeroed state. Allowed in a tick. */
static inline int knurl_shape_contact(const knurl_shape *shape, const knurl_contact_query *query,
                                      knurl_contact_state *state, knurl_contact *contact) KNURL_NONBLOCKING {
    return shape->functions->contact(shape->geometry, query, state, contact);
}

/* Returns 1 and the first hit of a segment. Allowed in a tick. */
static inline int knurl_shape_cast(const knurl_shape *shape, const knurl_cast *cast,
                                   knurl_cast_hit *hit) KNURL_NONBLOCKING {
    return shape->functions->cast(shape->geometry, cast, hit);
}

/* Sets state and contact at a point of the face that was hit, except normal and z. Allowed in a tick. */
static inline void knurl_shape_rest(const knurl_shape *shape, const knurl_cast_hit *hit, const double point[3],
                                    knurl_contact_state *state, knurl_contact *contact) KNURL_NONBLOCKING {
    shape->functions->rest(shape->geometry, hit, point, state, contact);
}

/* Tangent frame at a contact (x, y: unit, tangent to the contact's normal, y = n x x), and a mesh's coordinates (m; for
 * a plane use knurl_plane_coordinates(), which a smooth one does not need). Allowed in a tick. */
static inline void knurl_shape_frame(const knurl_shape *shape, const knurl_contact *contact, double x[3], double y[3],
                                     double coordinates[2]) KNURL_NONBLOCKING {
    if (shape->plane) {
        knurl_plane_axes(shape->plane, contact, x, y);
    } else {
        knurl_mesh_frame(shape->geometry, contact, x, y, coordinates);
    }
}

/* Rates of change of those coordinates (m/s) at a velocity of the HIP (m/s). Returns 0 if there are no coordinates: do
 * not use the outputs then. Allowed in a tick. */
static inline int knurl_shape_rates(const knurl_shape *shape, const knurl_contact *contact, const double velocity[3],
                                    double rates[2]) KNURL_NONBLOCKING {
    if (shape->plane) {
        return knurl_plane_rates(shape->plane, contact, velocity, rates);
    }
    const double moving[3] = {velocity[0], velocity[1], velocity[2]}; /* copies, see force_law.h */
    double found[2] = {0.0, 0.0};
    const int has_coordinates = knurl_mesh_rates(shape->geometry, contact, moving, found);
    rates[0] = found[0];
    rates[1] = found[1];
    return has_coordinates;
}

/* Start of a stroke, as a zeroed contact with proxy, normal, weights and triangle set: on a mesh, the face that a hand
 * would meet first. rotation (row-major): from the shape's axes to the scene's. */
static inline void knurl_shape_anchor(const knurl_shape *shape, const double rotation[9], knurl_contact *anchor) {
    shape->functions->anchor(shape->geometry, rotation, anchor);
}

static inline void knurl_shape_get_facts(const knurl_shape *shape, knurl_shape_facts *facts) {
    shape->functions->facts(shape->geometry, facts);
}

#endif

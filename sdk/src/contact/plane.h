/* A bounded plane: z = 0 in its own frame, front towards +z, a rectangle or any outline. Immutable once made.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_PLANE_H
#define KNURL_SRC_PLANE_H

#include "contact/contact.h"

/* One edge of an outline, made ready for counting crossings. */
typedef struct knurl_edge {
    double from[2];
    double to[2];
} knurl_edge;

typedef struct knurl_plane {
    double half_extents[2]; /* of the bounding rectangle, which is centred on the origin; m */
    double x[2];            /* the grating's x direction, unit, in the plane's axes, seen from the front */
    double map[2][3];       /* surface coordinates from the front: c_i = map[i][0] px + map[i][1] py + map[i][2], m */
    double stretch[3];      /* min, mean, max of d(surface coordinate)/d(metre along x) */
    double flatness;        /* m: how far the vertices lie off the plane */
    knurl_edge *outline;    /* closed loops, in any order; null: the bounding rectangle is the outline */
    uint32_t edge_count;
    int32_t has_coordinates; /* 0: the map is empty: neither uvs nor an axis */
    uint32_t triangle_count; /* of the mesh it was, without what was dropped; 0: it was given as a plane */
    uint32_t dropped;        /* triangles left out for want of area, or as duplicates */
    uint32_t reversed_twins; /* triangles left out because another has the same corners, facing the other way */
    int32_t double_sided;    /* 1: there were reversed twins */
} knurl_plane;

/* A rectangle: x along its x, coordinates in metres from its centre. */
void knurl_plane_from_rectangle(const double half_extents[2], knurl_plane *plane);

/* A flat mesh as a plane with its true outline. desc: checked by knurl_mesh_check(). axis: unit, the grating's x in the
 * mesh's frame, or null: tangents, else uvs. position, rotation: where the plane's frame stands in the mesh's. *why: a
 * static sentence in either case. Returns KNURL_OK with *plane null where the mesh does not come to a plane.
 * Errors: KNURL_ERROR_MEMORY. */
knurl_result knurl_plane_from_mesh(knurl_heap *heap, const knurl_mesh_desc *desc, const double axis[3],
                                   knurl_plane **plane, double position[3], double rotation[9], const char **why);

/* null is allowed */
void knurl_plane_destroy(knurl_heap *heap, knurl_plane *plane);

uint64_t knurl_plane_bytes(const knurl_plane *plane);

/* 1 and a contact while the HIP is inside, on the surface (KNURL_ON_SURFACE) or within reach, else 0 and a zeroed
 * state. Allowed in a tick. */
int knurl_plane_contact(const knurl_plane *plane, const knurl_contact_query *query, knurl_contact_state *state,
                        knurl_contact *contact) KNURL_NONBLOCKING;

/* Which way the grating's x runs at a contact (unit, tangent, in the plane's frame), and where on the grating it is (m;
 * not turned by the material's orientation). Allowed in a tick. */
void knurl_plane_frame(const knurl_plane *plane, const knurl_contact *contact, double x[3],
                       double coordinates[2]) KNURL_NONBLOCKING;

#endif

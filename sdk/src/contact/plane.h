/* A bounded plane: z = 0 in its own frame, front towards +z, with a rectangle or any outline. Immutable once made.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_PLANE_H
#define KNURL_SRC_PLANE_H

#include "base/heap.h"
#include "base/vec3.h"
#include "contact/contact.h"
#include "contact/shape_facts.h"

/* Maximum number of edges of an outline. A tick tests those in the HIP's band: a few for a disc, but all for a comb,
 * and at 1 ns each 64 cost as much as a whole tick of a plane. */
#define KNURL_OUTLINE_EDGES 64

/* Bands across y that an outline is divided into: each holds few edges, unless most edges run along y. */
#define KNURL_OUTLINE_BANDS 32

/* One edge of an outline, prepared for counting crossings. The plane is on its left, seen from the front. */
typedef struct knurl_edge {
    double from[2];
    double to[2];
    double slope; /* dx/dy; unused if the edge runs along x: nothing crosses it then */
} knurl_edge;

typedef struct knurl_plane {
    double half_extents[2]; /* of the bounding rectangle, centred on the origin; m */
    double x[2];            /* the grating's x direction, unit, in the plane's axes, seen from the front */
    double map[2][3];       /* surface coordinates from the front: c_i = map[i][0] px + map[i][1] py + map[i][2], m */
    double uv_scale[2];     /* m for each unit of u and v, if the map comes from uvs; otherwise 0 */
    double inside[2]; /* a point of the plane: its origin or, if a hole or an edge is there, the middle of a triangle */
    knurl_edge *outline; /* closed loops, in any order; null: the bounding rectangle */
    uint8_t *members;    /* edges of each band, band by band */
    double bands_per_metre;
    uint16_t bands[KNURL_OUTLINE_BANDS + 1]; /* first member of each band */
    uint32_t edge_count;
    int32_t has_coordinates; /* 0: neither uvs nor an axis; the map is empty */
    uint32_t triangle_count; /* triangles kept of a flat mesh; 0: created as a plane */
    int32_t double_sided;    /* 1: it has reversed twins */
    uint32_t other_users;    /* atomic: shapes that share it, not counting the first */
    knurl_shape_facts facts;
} knurl_plane;

/* Sets the stretch to `along` for x and to 1 for y. */
void knurl_plane_set_stretch(knurl_plane *plane, double along);

/* A rectangle, with coordinates in metres from its centre. axis: unit, the grating's x; null: the rectangle's x. */
void knurl_plane_from_rectangle(const double half_extents[2], const double axis[3], knurl_plane *plane);

/* Null is allowed. */
void knurl_plane_destroy(knurl_heap *heap, knurl_plane *plane);

/* Band of any y, also outside of the plane. A higher y never has a lower band. */
static inline int knurl_plane_band(const knurl_plane *plane, double y) {
    const double band = (y + plane->half_extents[1]) * plane->bands_per_metre;
    return !(band > 0.0) ? 0 : band < KNURL_OUTLINE_BANDS ? (int)band : KNURL_OUTLINE_BANDS - 1;
}

/* 1 if a point (of z = 0) is inside the outline. On an edge: 1 for a rectangle, either for other outlines. Allowed in a
 * tick. */
int knurl_plane_covers(const knurl_plane *plane, const double p[2]) KNURL_NONBLOCKING;

/* Point of the plane closest to p. */
void knurl_plane_closest(const knurl_plane *plane, const double p[3], double closest[3]);

uint64_t knurl_plane_bytes(const knurl_plane *plane);

/* m that a rectangle extends beyond its edges: rounding leaves no gap between planes side by side. */
#define KNURL_EDGE_SLACK 1e-10

/* 1 if a point (of z = 0) is inside the bounding rectangle. */
static inline int knurl_plane_spans(const knurl_plane *plane, const double p[2]) {
    return fabs(p[0]) <= plane->half_extents[0] + KNURL_EDGE_SLACK &&
           fabs(p[1]) <= plane->half_extents[1] + KNURL_EDGE_SLACK;
}

/* Contact of a HIP at a height of z (m) above a side (+1 or -1) of the plane. */
static inline void knurl_plane_set_contact(const double hip[3], double z, double side, knurl_contact *contact) {
    contact->proxy[0] = hip[0]; /* field by field: clearing the struct costs more than the rest */
    contact->proxy[1] = hip[1];
    contact->proxy[2] = contact->normal[0] = contact->normal[1] = 0.0;
    contact->normal[2] = side;
    contact->z = z;
}

/* Returns 1 and a contact while the HIP is inside, on the surface (KNURL_ON_SURFACE) or within reach, else 0 and a
 * zeroed state. Allowed in a tick. */
int knurl_plane_contact(const knurl_plane *plane, const knurl_contact_query *query, knurl_contact_state *state,
                        knurl_contact *contact) KNURL_NONBLOCKING;

/* Returns 1 and a hit if a segment crosses the plane. Allowed in a tick. */
int knurl_plane_cast(const knurl_plane *plane, const knurl_cast *cast, knurl_cast_hit *hit) KNURL_NONBLOCKING;

/* Sets a contact at a point of the plane; the caller sets normal and z. Allowed in a tick. */
void knurl_plane_rest(const knurl_cast_hit *hit, const double point[3], knurl_contact_state *state,
                      knurl_contact *contact) KNURL_NONBLOCKING;

/* Sets the seam from the plane's size and error. */
void knurl_plane_set_seam(knurl_plane *plane);

#endif

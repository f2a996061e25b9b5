/* A bounded plane: z = 0 in its own frame, front towards +z, a rectangle or any outline. Immutable once made.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_PLANE_H
#define KNURL_SRC_PLANE_H

#include "base/heap.h"
#include "base/vec3.h"
#include "contact/contact.h"

/* Edges that an outline may have. A tick looks at those in its HIP's band: a few of a disc's, but all of a comb's, and
 * at 1 ns each 64 cost as much as a plane's whole tick. */
#define KNURL_OUTLINE_EDGES 64

/* Bands that an outline is cut into, across y: few edges stand in one, unless most run along y. */
#define KNURL_OUTLINE_BANDS 32

/* One edge of an outline, made ready for counting crossings. The plane is on its left, seen from the front. */
typedef struct knurl_edge {
    double from[2];
    double to[2];
    double slope; /* dx/dy; any where the edge runs along x: nothing crosses it then */
} knurl_edge;

typedef struct knurl_plane {
    double half_extents[2]; /* of the bounding rectangle, which is centred on the origin; m */
    double x[2];            /* the grating's x direction, unit, in the plane's axes, seen from the front */
    double map[2][3];       /* surface coordinates from the front: c_i = map[i][0] px + map[i][1] py + map[i][2], m */
    double stretch[2][3];   /* min, mean, max of d(surface coordinate)/d(metre along x), and along y */
    double flatness;        /* m: how far the vertices lie off the plane or, those left out of it, off the outline */
    double seam;            /* m: farther beyond its edges a cast misses it */
    double inside[2]; /* a point of the plane: its origin; where a hole or an edge is there, the middle of a triangle */
    knurl_edge *outline; /* closed loops, in any order; null: the bounding rectangle is the outline */
    uint8_t *members;    /* band by band: its edges */
    double bands_per_metre;
    uint16_t bands[KNURL_OUTLINE_BANDS + 1]; /* where each begins among the members */
    uint32_t edge_count;
    int32_t has_coordinates; /* 0: the map is empty: neither uvs nor an axis */
    uint32_t triangle_count; /* of the mesh it was, without what was dropped; 0: it was given as a plane */
    uint32_t dropped;        /* triangles left out for want of area, or as duplicates */
    uint32_t reversed_twins; /* triangles left out because another has the same corners, facing the other way */
    int32_t double_sided;    /* 1: there were reversed twins */
    uint32_t other_users;    /* atomic: shapes that share it, without the first */
} knurl_plane;

/* Its coordinates run `along` times as fast as the way along x, and as fast as it along y. */
void knurl_plane_set_stretch(knurl_plane *plane, double along);

/* A rectangle, coordinates in metres from its centre. axis: unit, the grating's x; or null: the rectangle's. */
void knurl_plane_from_rectangle(const double half_extents[2], const double axis[3], knurl_plane *plane);

/* null is allowed */
void knurl_plane_destroy(knurl_heap *heap, knurl_plane *plane);

/* The band that a y is in, whatever it is: never a lower one for a higher y. */
static inline int knurl_plane_band(const knurl_plane *plane, double y) {
    const double band = (y + plane->half_extents[1]) * plane->bands_per_metre;
    return !(band > 0.0) ? 0 : band < KNURL_OUTLINE_BANDS ? (int)band : KNURL_OUTLINE_BANDS - 1;
}

/* 1 for a point (of z = 0) within the outline. On an edge: 1 on a rectangle's, either on another's. Allowed in a tick.
 */
int knurl_plane_covers(const knurl_plane *plane, const double p[2]) KNURL_NONBLOCKING;

/* The point of the plane that is closest to p. */
void knurl_plane_closest(const knurl_plane *plane, const double p[3], double closest[3]);

uint64_t knurl_plane_bytes(const knurl_plane *plane);

/* m that a rectangle reaches beyond its edges: rounding leaves no gap between planes side by side. */
#define KNURL_EDGE_SLACK 1e-10

/* 1 for a point (of z = 0) within the bounding rectangle. */
static inline int knurl_plane_spans(const knurl_plane *plane, const double p[2]) {
    return fabs(p[0]) <= plane->half_extents[0] + KNURL_EDGE_SLACK &&
           fabs(p[1]) <= plane->half_extents[1] + KNURL_EDGE_SLACK;
}

/* The contact of a HIP that is at a height of z (m) over a side (+1 or -1) of the plane. */
static inline void knurl_plane_set_contact(const double hip[3], double z, double side, knurl_contact *contact) {
    contact->proxy[0] = hip[0]; /* field by field: clearing all of it costs more than the rest */
    contact->proxy[1] = hip[1];
    contact->proxy[2] = contact->normal[0] = contact->normal[1] = 0.0;
    contact->normal[2] = side;
    contact->z = z;
}

/* 1 and a contact while the HIP is inside, on the surface (KNURL_ON_SURFACE) or within reach, else 0 and a zeroed
 * state. Allowed in a tick. */
int knurl_plane_contact(const knurl_plane *plane, const knurl_contact_query *query, knurl_contact_state *state,
                        knurl_contact *contact) KNURL_NONBLOCKING;

/* 1 and a hit where a way goes through the plane, not later than a `share` of 1. Allowed in a tick. */
int knurl_plane_cast(const knurl_plane *plane, const knurl_cast *cast, knurl_cast_hit *hit) KNURL_NONBLOCKING;

/* Contact at a point of the plane, its normal and z left to the caller. Allowed in a tick. */
void knurl_plane_rest(const knurl_cast_hit *hit, const double point[3], knurl_contact_state *state,
                      knurl_contact *contact) KNURL_NONBLOCKING;

/* Sets the seam, by the plane's size and how far it is off what was given. */
void knurl_plane_set_seam(knurl_plane *plane);

#endif

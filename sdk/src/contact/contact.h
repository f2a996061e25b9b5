/* Contact of one HIP with one shape, in the shape's own frame: a frictionless proxy (god-object).
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_CONTACT_H
#define KNURL_SRC_CONTACT_H

#include "contact/visits.h"

/* On its first tick a HIP counts as inside if it is at most this deep (m) behind a front face; later it must have
 * crossed the face. 10 mm: deeper than any hand presses before the force limit holds it. */
#define KNURL_CAPTURE_DEPTH 0.010

/* Within this distance (m) of the proxy the direction to it is noise: the triangle's normal is used instead. */
#define KNURL_NORMAL_DISTANCE 1e-6

/* Within this distance (m) a HIP is on the surface, and contact keeps the side that it came from: positions are
 * multiples of an encoder count and can lie exactly on a surface, up to rounding. */
#define KNURL_ON_SURFACE 1e-9

/* Contact state kept from tick to tick. Zero: not in contact. */
typedef struct knurl_contact_state {
    int32_t inside;    /* 1: the HIP has crossed the surface, or is on it */
    int32_t side;      /* +1: from the front; -1: from behind (double-sided); 0: not in contact */
    uint32_t triangle; /* the proxy's last triangle */
} knurl_contact_state;

/* Maximum number of triangles listed in a part of a mesh. */
#define KNURL_PART_TRIANGLES 32

/* Cached part of a mesh around a small box: the searches of a tick start there instead of at the root. An empty box:
 * nothing is cached. */
typedef struct knurl_part {
    double low[3]; /* shape's frame, m */
    double high[3];
    uint32_t node;                            /* root of the subtree that holds all triangles in the box */
    uint32_t count;                           /* triangles in the box; above KNURL_PART_TRIANGLES: not listed */
    uint32_t triangles[KNURL_PART_TRIANGLES]; /* in ascending order */
} knurl_part;

/* Makes the box empty. */
static inline void knurl_part_clear(knurl_part *part) {
    for (int axis = 0; axis < 3; axis++) {
        part->low[axis] = part->high[axis] = 0.0;
    }
}

/* Cached values of the triangle under the proxy (facet.h). Zero: empty. */
typedef struct knurl_facet knurl_facet;

/* Input of a contact query. */
typedef struct knurl_contact_query {
    double hip[3];
    double previous[3];   /* HIP position one tick earlier, in the same frame */
    double reach;         /* m: contact begins this far in front of the surface, at the height of the highest crest */
    int32_t has_previous; /* 0: first tick, KNURL_CAPTURE_DEPTH applies */
    int32_t double_sided;
    knurl_facet *facet;   /* cache of this contact, zeroed when contact begins; null: not cached */
    knurl_part *part;     /* cache of this contact, zeroed for a new shape; null: not cached */
    knurl_visits *visits; /* budget of the query; null: unlimited */
} knurl_contact_query;

/* The mesh has parts that intersect or touch. */
#define KNURL_UNSURE_PARTS 2

typedef struct knurl_contact {
    double proxy[3];    /* on the shape; in a mesh's fold of more than 90 degrees up to two seams off it */
    double normal[3];   /* unit, towards the side that the HIP came from */
    double z;           /* m along the normal, negative inside */
    double weights[3];  /* mesh: barycentric coordinates of the proxy */
    uint32_t triangle;  /* mesh: the proxy's triangle */
    knurl_facet *facet; /* mesh: cache of that triangle; null: not cached */
    int32_t unsure; /* also set without contact. Not 0: the HIP may have passed a face of this shape, at a rim, a seam
                       or another part, and a cast is needed */
} knurl_contact;

/* Input of a cast, which finds the first face that a segment crosses from its front. */
typedef struct knurl_cast {
    double from[3];
    double to[3];
    int32_t double_sided;
    knurl_part *part;     /* as in a query */
    knurl_visits *visits; /* budget of the cast; null: unlimited */
} knurl_cast;

/* Result of a cast. Faces extend beyond their edges by the shape's seam: no segment passes between two that touch. */
typedef struct knurl_cast_hit {
    double share;      /* fraction of the segment, 0 to 1 */
    double height;     /* m: of the segment's start above the face */
    double point[3];   /* on the face */
    double normal[3];  /* unit, of the face, towards the segment's start */
    uint32_t triangle; /* mesh: triangle; plane: 0 */
    int32_t side;      /* +1: from the front; -1: from behind (double-sided) */
} knurl_cast_hit;

/* m: a segment may start this far behind a face and still hit it. Twice the height at which proxies rest. */
#define KNURL_CAST_SLACK 2e-9

/* m: minimum size of a plane or a triangle; the directions of a smaller one would be noise. */
#define KNURL_EXTENT_MIN 1e-9

/* Two surfaces side by side touch within this distance (m) or this fraction of their size, whichever is larger: the
 * rounding of positions in single precision after a few modelling steps. */
#define KNURL_SEAM       1e-7
#define KNURL_SEAM_SHARE 1e-6

#endif

/* Contact of one HIP with one shape, in the shape's own frame: a frictionless proxy (god-object).
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_CONTACT_H
#define KNURL_SRC_CONTACT_H

#include "contact/visits.h"

/* A HIP that is seen for the first time counts as pressed in when it is at most this deep (m) behind a front face.
 * Later it must have come through the face. 10 mm: deeper than any hand presses before the force limit holds it. */
#define KNURL_CAPTURE_DEPTH 0.010

/* Closer to the proxy than this (m), the direction to it is noise: the triangle's normal is used. */
#define KNURL_NORMAL_DISTANCE 1e-6

/* So near (m), a HIP is on the surface, and contact keeps the side that it came from: positions that are multiples of
 * an encoder's count stop on surfaces exactly, give or take what rounding adds. */
#define KNURL_ON_SURFACE 1e-9

/* What contact remembers from tick to tick. Zero: not in contact. */
typedef struct knurl_contact_state {
    int32_t inside;    /* 1: the HIP has come through the surface, or stands on it */
    int32_t side;      /* +1: from the front; -1: from behind (double-sided); 0: not in contact */
    uint32_t triangle; /* where the proxy was */
} knurl_contact_state;

/* The most triangles that are listed in a part of a mesh. */
#define KNURL_PART_TRIANGLES 32

/* What searches of a mesh within a small box look at, so that not every one of a tick begins at the root. An empty box:
 * nothing is known. */
typedef struct knurl_part {
    double low[3]; /* shape's frame, m */
    double high[3];
    uint32_t node;  /* of the hierarchy: nothing outside of it meets the box */
    uint32_t count; /* the triangles that meet the box; more than KNURL_PART_TRIANGLES: they are not listed */
    uint32_t triangles[KNURL_PART_TRIANGLES]; /* in ascending order */
} knurl_part;

/* Empties its box. */
static inline void knurl_part_clear(knurl_part *part) {
    for (int axis = 0; axis < 3; axis++) {
        part->low[axis] = part->high[axis] = 0.0;
    }
}

/* What is kept of the triangle that a proxy is on (facet.h). Zero: nothing. */
typedef struct knurl_facet knurl_facet;

/* What is asked at a tick. */
typedef struct knurl_contact_query {
    double hip[3];
    double previous[3];   /* where the HIP was a tick ago, in the same frame */
    double reach;         /* m in front of the surface that count as contact: the highest crest */
    int32_t has_previous; /* 0: a first tick; KNURL_CAPTURE_DEPTH applies */
    int32_t double_sided;
    knurl_facet *facet;   /* this contact's, zero when it begins; or null: none is kept */
    knurl_part *part;     /* this contact's, zero for a shape that is looked at anew; or null: none is kept */
    knurl_visits *visits; /* what it may look at; null: no limit */
} knurl_contact_query;

/* The mesh has parts that go through or touch each other. */
#define KNURL_UNSURE_PARTS 2

typedef struct knurl_contact {
    double proxy[3];    /* on the shape; in a mesh's fold of more than 90 degrees up to two seams off it */
    double normal[3];   /* unit, towards the side that the HIP came from */
    double z;           /* m along the normal, negative inside */
    double weights[3];  /* mesh: barycentric coordinates of the proxy */
    uint32_t triangle;  /* mesh: which */
    knurl_facet *facet; /* mesh: that triangle's; null where none is kept */
    int32_t unsure; /* set without contact, too. Not 0: the HIP may have passed a face of this shape, by its rim, a seam
                       or another part; whether it has, a cast tells */
} knurl_contact;

/* What is asked of a cast: where a straight way first goes through a face, from its front. */
typedef struct knurl_cast {
    double from[3];
    double to[3];
    int32_t double_sided;
    knurl_part *part;     /* as in a query */
    knurl_visits *visits; /* what it may look at; null: no limit */
} knurl_cast;

/* Faces reach beyond their edges by a shape's seam, so that no way leads between two that touch. */
typedef struct knurl_cast_hit {
    double share;      /* of the way, 0 to 1 */
    double height;     /* m: of the way's beginning above the face */
    double point[3];   /* of the face */
    double normal[3];  /* unit, of the face, towards the way's beginning */
    uint32_t triangle; /* mesh: which; plane: 0 */
    int32_t side;      /* +1: from the front; -1: from behind (double-sided) */
} knurl_cast_hit;

/* m: a way may begin so far behind a face and still go through it. Twice the height that proxies rest at. */
#define KNURL_CAST_SLACK 2e-9

/* m: what is smaller is no surface: its directions would be noise. */
#define KNURL_EXTENT_MIN 1e-9

/* Two surfaces that run side by side within this (m) touch, and within this share of their size: what rounding leaves
 * of positions in single precision after a few steps of somebody's modelling. */
#define KNURL_SEAM       1e-7
#define KNURL_SEAM_SHARE 1e-6

#endif

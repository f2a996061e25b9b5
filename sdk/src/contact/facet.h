/* Cache of the triangle under the proxy. Its values hold as long as the HIP stays above that triangle.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_FACET_H
#define KNURL_SRC_FACET_H

#include "contact/closest_point.h"
#include "contact/contact.h"

#include <string.h>

struct knurl_facet {
    uint32_t triangle;
    int32_t side; /* that the HIP came from, +1 or -1; 0: the cache is empty */
    double corners[3][3], ab[3], ac[3];
    double cross[3]; /* as knurl_closest_point's */
    double cross2;
    double inverse; /* 1 / cross2 */
    double unit[3]; /* unit normal towards `side` */
    /* set by mesh_frame.c */
    int32_t has_frame;     /* 1: x and y are set */
    int32_t has_uvs;       /* 1: the uvs have an area and are set */
    int32_t has_gradients; /* while has_frame: 1: `gradients` are set */
    double x[3], y[3];
    double u0, v0;          /* at the first corner */
    double u1, v1, u2, v2;  /* differences at the others */
    double scale[2];        /* m per u, and per v; signed so that y = n x x */
    double gradients[2][3]; /* growth of the coordinates per metre of a way along the triangle */
};

/* Fills in the cache from a closest point inside the triangle. unit: its unit normal, towards `side`. */
static inline void knurl_facet_keep(const knurl_closest_point *closest, int32_t side, const double unit[3],
                                    knurl_facet *f) {
    f->triangle = closest->triangle;
    f->side = side;
    f->has_frame = 0;
    memcpy(f->corners, closest->corners, sizeof f->corners);
    vec3_sub(closest->corners[1], closest->corners[0], f->ab);
    vec3_sub(closest->corners[2], closest->corners[0], f->ac);
    vec3_copy(closest->cross, f->cross);
    f->cross2 = closest->cross2;
    f->inverse = 1.0 / closest->cross2;
    vec3_copy(unit, f->unit);
}

/* Returns 1 and the contact if the HIP's closest point is inside the triangle, else 0. inside: for
 * knurl_closest_on_edges(). The same numbers as from knurl_closest_on_triangle(). */
static inline int knurl_facet_contact(const knurl_facet *f, const double hip[3], double inside[2], knurl_contact *c) {
    double ap[3], across[3], offset[3];
    vec3_sub(hip, f->corners[0], ap);
    vec3_cross(f->cross, ap, across);
    inside[0] = vec3_dot(across, f->ac);
    inside[1] = -vec3_dot(across, f->ab);
    if (!(inside[0] > 0.0 && inside[1] > 0.0 && inside[0] + inside[1] < f->cross2)) {
        return 0;
    }
    vec3_scale(vec3_dot(ap, f->cross) * f->inverse, f->cross, offset);
    vec3_sub(hip, offset, c->proxy);
    c->weights[1] = inside[0] * f->inverse;
    c->weights[2] = inside[1] * f->inverse;
    c->weights[0] = 1.0 - c->weights[1] - c->weights[2];
    c->triangle = f->triangle;
    vec3_copy(f->unit, c->normal);
    c->z = vec3_dot(offset, f->unit);
    return 1;
}

/* The closest point to a HIP on the triangle's edges. inside: from knurl_facet_contact(). */
static inline void knurl_facet_edges(const knurl_facet *f, const double hip[3], const double inside[2],
                                     knurl_closest_point *closest) {
    closest->triangle = f->triangle;
    closest->cross2 = f->cross2;
    vec3_copy(f->cross, closest->cross);
    memcpy(closest->corners, f->corners, sizeof closest->corners);
    knurl_closest_on_edges(hip, inside, closest);
}

#endif

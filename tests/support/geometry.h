/* References for the tests of contact: distances and crossings by brute force, with other formulas than the library's.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_GEOMETRY_H
#define KNURL_TEST_GEOMETRY_H

#include "support/shapes.h"

static inline double dot3(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/** out = a + s b */
static inline void add3(const double a[3], double s, const double b[3], double out[3]) {
    for (int axis = 0; axis < 3; axis++) {
        out[axis] = a[axis] + s * b[axis];
    }
}

static inline double length3(const double a[3]) {
    return sqrt(dot3(a, a));
}

static inline double distance3(const double a[3], const double b[3]) {
    double offset[3];
    add3(a, -1.0, b, offset);
    return length3(offset);
}

static inline void cross3(const double a[3], const double b[3], double out[3]) {
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/** The unit normal of a triangle; returns twice its area. */
static inline double normal3(const double corners[3][3], double out[3]) {
    double edge1[3];
    double edge2[3];
    add3(corners[1], -1.0, corners[0], edge1);
    add3(corners[2], -1.0, corners[0], edge2);
    cross3(edge1, edge2, out);
    const double size = length3(out);
    for (int axis = 0; axis < 3; axis++) {
        out[axis] /= size;
    }
    return size;
}

/** Evenly on the unit sphere. */
static inline void random_direction(uint64_t *seed, double out[3]) {
    double length;
    do {
        for (int axis = 0; axis < 3; axis++) {
            out[axis] = random_between(seed, -1.0, 1.0);
        }
        length = length3(out);
    } while (length > 1.0 || length < 0.1);
    for (int axis = 0; axis < 3; axis++) {
        out[axis] /= length;
    }
}

/** How far a point of a triangle's plane is inside the triangle: m to the nearest edge, negative outside. */
static inline double inset3(const double corners[3][3], const double p[3]) {
    double normal[3];
    double least = HUGE_VAL;
    (void)normal3(corners, normal);
    for (int k = 0; k < 3; k++) {
        double edge[3];
        double inwards[3];
        double offset[3];
        add3(corners[(k + 1) % 3], -1.0, corners[k], edge);
        cross3(normal, edge, inwards);
        add3(p, -1.0, corners[k], offset);
        least = fmin(least, dot3(offset, inwards) / length3(inwards));
    }
    return least;
}

static inline double segment_distance(const double a[3], const double b[3], const double p[3]) {
    double along[3];
    double offset[3];
    double nearest[3];
    add3(b, -1.0, a, along);
    add3(p, -1.0, a, offset);
    const double t = dot3(offset, along) / dot3(along, along);
    add3(a, fmin(1.0, fmax(0.0, t)), along, nearest);
    return distance3(nearest, p);
}

/** m from a point to a triangle: to its plane if above it, otherwise to the nearest of its three edges. */
static inline double triangle_distance(const double corners[3][3], const double p[3]) {
    double normal[3];
    double offset[3];
    double foot[3];
    (void)normal3(corners, normal);
    add3(p, -1.0, corners[0], offset);
    const double height = dot3(offset, normal);
    add3(p, -height, normal, foot);
    if (inset3(corners, foot) >= 0.0) {
        return fabs(height);
    }
    double least = HUGE_VAL;
    for (int k = 0; k < 3; k++) {
        least = fmin(least, segment_distance(corners[k], corners[(k + 1) % 3], p));
    }
    return least;
}

/** m from a point to the nearest triangle of a shape. */
static inline double shape_distance(const shape *s, const double p[3]) {
    double least = HUGE_VAL;
    for (uint32_t i = 0; i < s->index_count / 3; i++) {
        double corners[3][3];
        shape_corners(s, i, corners);
        least = fmin(least, triangle_distance((const double (*)[3])corners, p));
    }
    return least;
}

/** How a segment meets a triangle. */
typedef struct crossing {
    double s;      /**< 0 to 1 along the segment */
    double margin; /**< m from the meeting point inwards to the nearest edge; negative: it misses */
    int side;      /**< +1: from the front, -1: from behind */
} crossing;

/** 0 if the segment stays on one side of the triangle's plane. */
static inline int cross_triangle(const double corners[3][3], const double a[3], const double b[3], crossing *out) {
    double normal[3];
    double from[3];
    double to[3];
    double along[3];
    double point[3];
    (void)normal3(corners, normal);
    add3(a, -1.0, corners[0], from);
    add3(b, -1.0, corners[0], to);
    const double before = dot3(from, normal);
    const double after = dot3(to, normal);
    if ((before > 0.0) == (after > 0.0)) {
        return 0;
    }
    out->side = before > 0.0 ? 1 : -1;
    out->s = before / (before - after);
    add3(b, -1.0, a, along);
    add3(a, out->s, along, point);
    out->margin = inset3(corners, point);
    return 1;
}

/** Signed distance of a box round the origin, m; negative inside. */
static inline double box_distance(const double half[3], const double p[3]) {
    double outside[3];
    double inside = -HUGE_VAL;
    for (int axis = 0; axis < 3; axis++) {
        const double d = fabs(p[axis]) - half[axis];
        outside[axis] = fmax(0.0, d);
        inside = fmax(inside, d);
    }
    return inside < 0.0 ? inside : length3(outside);
}

#endif

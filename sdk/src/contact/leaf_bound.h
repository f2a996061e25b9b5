/* Lower bounds of the distances from a point to four triangles at a time, in single precision: of a leaf's triangles
 * only the few that may be nearest are then computed in double. Everything here is allowed in a tick.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_LEAF_BOUND_H
#define KNURL_SRC_LEAF_BOUND_H

#include "contact/bvh_search.h"
#include "contact/mesh.h"

/* A coordinate of four points each. */
typedef struct knurl_lanes {
    knurl_float4 x, y, z;
} knurl_lanes;

static inline knurl_lanes lanes_sub(const knurl_lanes a, const knurl_lanes b) {
    return (knurl_lanes){a.x - b.x, a.y - b.y, a.z - b.z};
}

static inline knurl_float4 lanes_dot(const knurl_lanes a, const knurl_lanes b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline knurl_lanes lanes_cross(const knurl_lanes a, const knurl_lanes b) {
    return (knurl_lanes){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/* Squared distance from the origin to the edges that go from a by ab. */
static inline knurl_float4 edges_distance2(const knurl_lanes a, const knurl_lanes ab, knurl_float4 ab2) {
    const knurl_float4 zero = {0.0f, 0.0f, 0.0f, 0.0f}, one = {1.0f, 1.0f, 1.0f, 1.0f};
    knurl_float4 along = -lanes_dot(a, ab) / ab2;
    along = knurl_float4_max(knurl_float4_min(along, one), zero);
    const knurl_lanes at = {a.x + along * ab.x, a.y + along * ab.y, a.z + along * ab.z};
    return lanes_dot(at, at);
}

/* A point, in all lanes: as floats, and their rounding error. */
typedef struct knurl_leaf_point {
    knurl_float4 at[3], rest[3];
} knurl_leaf_point;

static inline void knurl_leaf_point_set(const double p[3], knurl_leaf_point *out) {
    for (int axis = 0; axis < 3; axis++) {
        const float at = (float)p[axis], rest = (float)(p[axis] - (double)at);
        out->at[axis] = (knurl_float4){at, at, at, at};
        out->rest[axis] = (knurl_float4){rest, rest, rest, rest};
    }
}

/* Corner k of four triangles from `first` on, seen from a point. Those after `last` are the last one again. */
static inline knurl_lanes leaf_corners(const knurl_mesh *mesh, uint32_t first, uint32_t last, uint32_t k,
                                       const knurl_leaf_point *from) {
    const float *p[4];
    for (uint32_t i = 0; i < 4; i++) {
        const uint32_t triangle = first + i < last ? first + i : last;
        p[i] = &mesh->positions[3 * (size_t)mesh->triangles[3 * (size_t)triangle + k]];
    }
    const knurl_lanes out = {(knurl_float4){p[0][0], p[1][0], p[2][0], p[3][0]} - from->at[0] - from->rest[0],
                             (knurl_float4){p[0][1], p[1][1], p[2][1], p[3][1]} - from->at[1] - from->rest[1],
                             (knurl_float4){p[0][2], p[1][2], p[2][2], p[3][2]} - from->at[2] - from->rest[2]};
    return out;
}

/* Rounding moves a corner, seen from the point, by some 1e-7 of its distance, and a face by that times the product of
 * two edges over their normal's length, which is large in a needle: an error e of the distance d. (d - e)^2 is at least
 * d^2 (1 - share) - e^2 / share. 15 million random triangles needed less than a fiftieth of this slack. */
#define LEAF_SHARE 1e-4f
#define LEAF_SLACK 1e-9f

/* Lower bounds of the squared distances from `from`; NaN or negative: not known. */
static inline knurl_float4 knurl_leaf_bound2(const knurl_mesh *mesh, uint32_t first, uint32_t last,
                                             const knurl_leaf_point *from) {
    const knurl_float4 zero = {0.0f, 0.0f, 0.0f, 0.0f};
    const knurl_lanes a = leaf_corners(mesh, first, last, 0, from);
    const knurl_lanes b = leaf_corners(mesh, first, last, 1, from);
    const knurl_lanes c = leaf_corners(mesh, first, last, 2, from);
    const knurl_lanes ab = lanes_sub(b, a), ac = lanes_sub(c, a), bc = lanes_sub(c, b);
    const knurl_lanes normal = lanes_cross(ab, ac);
    const knurl_float4 normal2 = lanes_dot(normal, normal);
    const knurl_float4 ab2 = lanes_dot(ab, ab), ac2 = lanes_dot(ac, ac), inverse = 1.0f / normal2;
    const knurl_float4 left = lanes_dot(normal, lanes_cross(a, ab)), right = lanes_dot(normal, lanes_cross(ac, a));
    const knurl_float4 height = lanes_dot(normal, a);
    knurl_float4 edge2 = edges_distance2(a, ab, ab2);
    const knurl_float4 second2 = edges_distance2(a, ac, ac2), third2 = edges_distance2(b, bc, lanes_dot(bc, bc));
    edge2 = knurl_float4_min(knurl_float4_min(second2, third2), edge2);
    const knurl_mask4 inside = (left >= zero) & (right >= zero) & (left + right <= normal2);
    const knurl_float4 face2 = height * inverse * height;
    const knurl_float4 distance2 = (knurl_float4)(((knurl_mask4)face2 & inside) | ((knurl_mask4)edge2 & ~inside));
    return (1.0f - LEAF_SHARE) * distance2 - LEAF_SLACK * (lanes_dot(a, a) + ab2 + ac2) * (1.0f + ab2 * ac2 * inverse);
}

#endif

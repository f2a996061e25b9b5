/* Tests of a hierarchy's nodes on four floats at a time, for searches of many nodes. Everything here is allowed in a
 * tick. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_BVH_SEARCH_H
#define KNURL_SRC_BVH_SEARCH_H

#include "contact/bvh.h"
#include "contact/float4.h"

#include <string.h>

/* A box, rounded outwards. */
typedef struct knurl_search_box {
    knurl_float4 low, high;
} knurl_search_box;

/* More than two roundings to float: relative, and absolute for subnormal numbers. */
#define KNURL_FLOAT_ROUNDING 1.2e-7f
#define KNURL_FLOAT_TINY     1e-37f

static inline void knurl_search_box_set(const double low[3], const double high[3], knurl_search_box *box) {
    for (int axis = 0; axis < 3; axis++) {
        const float least = (float)low[axis], most = (float)high[axis];
        box->low[axis] = least - (fabsf(least) * KNURL_FLOAT_ROUNDING + KNURL_FLOAT_TINY);
        box->high[axis] = most + (fabsf(most) * KNURL_FLOAT_ROUNDING + KNURL_FLOAT_TINY);
    }
    box->low[3] = box->high[3] = 0.0f;
}

/* A point, rounded down and up. The fourth numbers make the gap to a node's integers 0: as floats those are subnormal,
 * which multiplications are slow with. */
typedef struct knurl_search_point {
    knurl_float4 low, high;
} knurl_search_point;

static inline void knurl_search_point_set(const double p[3], knurl_search_point *point) {
    knurl_search_box box;
    knurl_search_box_set(p, p, &box);
    point->low = box.low;
    point->high = box.high;
    point->low[3] = -3e38f;
    point->high[3] = 3e38f;
}

/* A lower bound of the squared distance from the point to a box: less than it by rounding only. */
static inline float knurl_search_distance2(const knurl_search_point *point, knurl_float4 min, knurl_float4 max) {
    const knurl_float4 zero = {0.0f, 0.0f, 0.0f, 0.0f};
    const knurl_float4 gap = knurl_float4_max(knurl_float4_max(min - point->high, point->low - max), zero);
    const knurl_float4 square = gap * gap;
    return (square[0] + square[1] + square[2]) * (1.0f - 1e-6f);
}

static inline float knurl_search_node_distance2(const knurl_search_point *point, const knurl_bvh_node *node) {
    knurl_float4 min, max; /* the fourth numbers are the node's integers, and ignored */
    memcpy(&min, node, sizeof min);
    memcpy(&max, (const char *)node + sizeof min, sizeof max);
    return knurl_search_distance2(point, min, max);
}

static inline int knurl_search_box_meets_node(const knurl_search_box *box, const knurl_bvh_node *node) {
    knurl_float4 min, max; /* the fourth numbers are the node's integers, and ignored */
    memcpy(&min, node, sizeof min);
    memcpy(&max, (const char *)node + sizeof min, sizeof max);
    return !knurl_mask4_any((box->low > max) | (box->high < min));
}

#endif

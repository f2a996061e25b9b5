/* A bounding volume hierarchy over triangles. Immutable once built; traversed without recursion.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_BVH_H
#define KNURL_SRC_BVH_H

#include "base/heap.h"
#include "contact/float4.h"

#include <math.h>

/* Maximum depth of a tree, and so the size of a traversal's stack. */
#define KNURL_BVH_DEPTH_MAX 64

/* 32 bytes. The left child of an inner node follows it directly. */
typedef struct knurl_bvh_node {
    float min[3];
    uint32_t first; /* leaf: its first triangle; inner: its right child */
    float max[3];
    uint32_t count; /* leaf: number of triangles; inner: 0 */
} knurl_bvh_node;

/* The fourth numbers are 0 at first; a build uses them. */
typedef struct knurl_box {
    knurl_float4 min, max;
} knurl_box;

/* Builds a hierarchy over `count` (> 0) boxes, which it sorts. order: `count` entries, filled in with the boxes' former
 * indices in leaf order; each leaf is a run of at most `leaf_size`. The nodes come from `heap`; scratch memory is
 * freed. Errors: KNURL_ERROR_MEMORY. */
knurl_result knurl_bvh_build(knurl_heap *heap, knurl_box *boxes, uint32_t count, uint32_t leaf_size, uint32_t *order,
                             knurl_bvh_node **nodes, uint32_t *node_count);

/* Squared distance from a point to a node's box; 0 inside. Allowed in a tick. */
static inline double knurl_bvh_distance2(const knurl_bvh_node *node, const double p[3]) KNURL_NONBLOCKING {
    double sum = 0.0;
    for (int axis = 0; axis < 3; axis++) {
        const double below = (double)node->min[axis] - p[axis];
        const double above = p[axis] - (double)node->max[axis];
        const double gap = below > above ? below : above;
        sum += gap > 0.0 ? gap * gap : 0.0;
    }
    return sum;
}

/* Bounding box of a segment, expanded by `margin`. Allowed in a tick. */
static inline void knurl_bvh_bound(const double a[3], const double b[3], double margin, double low[3],
                                   double high[3]) KNURL_NONBLOCKING {
    for (int axis = 0; axis < 3; axis++) {
        low[axis] = (a[axis] < b[axis] ? a[axis] : b[axis]) - margin;
        high[axis] = (a[axis] < b[axis] ? b[axis] : a[axis]) + margin;
    }
}

/* 1 if a box overlaps a node's box. Allowed in a tick. */
static inline int knurl_bvh_meets(const knurl_bvh_node *node, const double low[3],
                                  const double high[3]) KNURL_NONBLOCKING {
    for (int axis = 0; axis < 3; axis++) {
        if (low[axis] > (double)node->max[axis] || high[axis] < (double)node->min[axis]) {
            return 0;
        }
    }
    return 1;
}

#endif

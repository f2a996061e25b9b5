/* Checks of the hierarchy over a mesh's triangles. SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_HIERARCHY_H
#define KNURL_TEST_HIERARCHY_H

#include "support/probe.h"

#include "contact/bvh.h"
#include "contact/mesh.h"

static inline void check_box(const knurl_bvh_node *inner, const float min[3], const float max[3]) {
    for (int axis = 0; axis < 3; axis++) {
        assert_true(inner->min[axis] >= min[axis] && inner->max[axis] <= max[axis]);
        assert_true(inner->min[axis] <= inner->max[axis]);
    }
}

/* Counts each leaf's triangles and checks that they are in its box; returns the depth below a node. */
static inline uint32_t check_node(const knurl_mesh *mesh, uint32_t index, uint8_t *seen, uint32_t *nodes) {
    const knurl_bvh_node *node = &mesh->nodes[index];
    assert_true(index < mesh->node_count);
    (*nodes)++;
    if (node->count == 0) {
        const uint32_t children[2] = {index + 1, node->first};
        uint32_t depth = 0;
        for (int i = 0; i < 2; i++) {
            assert_true(children[i] > index && children[i] < mesh->node_count);
            check_box(&mesh->nodes[children[i]], node->min, node->max);
            const uint32_t below = check_node(mesh, children[i], seen, nodes);
            depth = below > depth ? below : depth;
        }
        return depth + 1;
    }
    assert_in_range(node->count, 1, 8); /* a handful: the work of a walk is bounded */
    for (uint32_t i = node->first; i < node->first + node->count; i++) {
        assert_true(i < mesh->triangle_count);
        seen[i]++;
        for (uint32_t k = 0; k < 3; k++) {
            const float *p = &mesh->positions[3 * (size_t)mesh->triangles[3 * (size_t)i + k]];
            for (int axis = 0; axis < 3; axis++) {
                assert_true(p[axis] >= node->min[axis] && p[axis] <= node->max[axis]);
            }
        }
    }
    return 1;
}

/* Every triangle in exactly one leaf, every node reached once, boxes within boxes, no deeper than a walk's stack. */
static inline void check_hierarchy(const knurl_mesh *mesh) {
    uint8_t *seen = calloc(mesh->triangle_count, 1);
    uint32_t nodes = 0;
    assert_true(check_node(mesh, 0, seen, &nodes) <= KNURL_BVH_DEPTH_MAX);
    assert_int_equal(nodes, mesh->node_count);
    for (uint32_t i = 0; i < mesh->triangle_count; i++) {
        assert_int_equal(seen[i], 1);
    }
    free(seen);
}

/* A sum over the corners of all triangles, independent of the order in a leaf and the numbering of vertices.
 */
static inline uint64_t sum_of_corners(const float *positions, const uint32_t *indices, size_t count) {
    uint64_t sum = 0;
    for (size_t i = 0; i < count; i += 3) {
        uint64_t hash = 1;
        for (size_t k = 0; k < 9; k++) {
            uint32_t bits;
            memcpy(&bits, &positions[3 * (size_t)indices[i + k / 3] + k % 3], sizeof bits);
            hash = hash * 0x9e3779b97f4a7c15u + bits;
        }
        sum += hash * hash;
    }
    return sum;
}

#endif

// Knurl: the tree of a glTF file's nodes, walked without recursion.
// SPDX-License-Identifier: MIT
#ifndef KNURL_GLTF_HIERARCHY_HPP
#define KNURL_GLTF_HIERARCHY_HPP

#include "fields.hpp"

namespace knurl::gltf {

/** Nodes below each other. */
constexpr size_t node_depth_max = 1024;

struct Hierarchy {
    std::vector<int32_t> parents; ///< -1: none
    std::vector<uint32_t> shown;  ///< nodes of the scene to load, depth first, children in their order
};

/** Checks all nodes: each has one parent at most and is not its own ancestor, none is deeper than node_depth_max. */
Hierarchy read_hierarchy(const Fields &root);

} // namespace knurl::gltf
#endif

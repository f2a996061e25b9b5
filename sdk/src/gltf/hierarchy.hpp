// Knurl: the tree of a glTF file's nodes, walked without recursion.
// SPDX-License-Identifier: MIT
#ifndef KNURL_GLTF_HIERARCHY_HPP
#define KNURL_GLTF_HIERARCHY_HPP

#include "fields.hpp"

namespace knurl::gltf {

/** The deepest nesting of nodes. */
constexpr size_t node_depth_max = 1024;

struct Hierarchy {
    std::vector<int32_t> parents; ///< -1: a root
    std::vector<uint32_t> shown;  ///< nodes of the scene to load, depth first, children in their order
};

/** Throws Failure if a node has two parents, is its own ancestor or is deeper than node_depth_max. */
Hierarchy read_hierarchy(const Fields &root);

} // namespace knurl::gltf
#endif

// Knurl: what of a glTF file is to be loaded: its structure checked, its tags merged, nothing but JSON looked at.
// SPDX-License-Identifier: MIT
#ifndef KNURL_GLTF_OUTLINE_HPP
#define KNURL_GLTF_OUTLINE_HPP

#include "budget.hpp"
#include "tags.hpp"

namespace knurl::gltf {

/** One surface to be: a tagged primitive as one node shows it. */
struct Instance {
    uint32_t node = 0;
    uint32_t mesh = 0;
    uint32_t primitive = 0;
    Tag tag; ///< merged; the required keys are there
    bool double_sided = false;
    std::string name; ///< not unique yet; at most name_max bytes
};

struct Outline {
    std::vector<Instance> instances; ///< in the order of the scene's nodes, depth first
    std::vector<int32_t> parents;    ///< of each node; -1: none
    uint32_t skipped = 0;            ///< primitives without a tag, one a node
};

/** root: the file's JSON. Throws Failure. */
Outline read_outline(const Json &root, Budget &budget);

/** The three roles of "where" in messages about an instance: "node 'n' (1), mesh 'm' (0), primitive 2". */
std::string where_of(const Json &root, const Instance &instance);

} // namespace knurl::gltf
#endif

// Knurl: the list of surfaces to load from a glTF file. Checks its structure and merges its tags; reads only JSON.
// SPDX-License-Identifier: MIT
#ifndef KNURL_GLTF_OUTLINE_HPP
#define KNURL_GLTF_OUTLINE_HPP

#include "file/budget.hpp"
#include "tags.hpp"

namespace knurl::gltf {

/** A surface's name is at most 255 bytes: a node's or a mesh's name, " / ", a material's name, " (2)". */
constexpr size_t name_part_max = 115; ///< plus "..."

/** A surface to make: a tagged primitive shown by one node. */
struct Instance {
    uint32_t node = 0;
    uint32_t mesh = 0;
    uint32_t primitive = 0;
    Tag tag; ///< merged; has all required keys
    bool double_sided = false;
    std::string name; ///< not unique yet; at most 255 bytes
};

struct Outline {
    std::vector<Instance> instances; ///< in the order of the scene's nodes, depth first
    std::vector<int32_t> parents;    ///< of each node; -1: a root
    uint32_t skipped = 0;            ///< primitives without a tag, counted once per node
};

/** Throws Failure. */
Outline read_outline(const Fields &root, Budget &budget);

/** The start of messages about an instance: "node 'n' (1), mesh 'm' (0), primitive 2". */
std::string where_of(const Fields &root, const Instance &instance);

} // namespace knurl::gltf
#endif

// Knurl: the part of a glTF file that its tagged surfaces need, with all types and ranges checked. The rest is left out
// and costs nothing. Elements are renumbered; messages use their numbers in the file.
// SPDX-License-Identifier: MIT
#ifndef KNURL_GLTF_FILTER_HPP
#define KNURL_GLTF_FILTER_HPP

#include "outline.hpp"
#include "tinygltf.hpp"

#include <unordered_map>

namespace knurl::gltf {

/** A buffer used by a tagged surface. */
struct BufferSource {
    uint32_t number = 0; ///< in the file
    uint32_t byte_length = 0;
    const std::string *uri = nullptr; ///< in the file's JSON; null: the BIN chunk
};

/** All indices are places in these vectors, not numbers in the file. */
struct Filtered {
    std::vector<tinygltf::Node> nodes;
    std::vector<tinygltf::Primitive> primitives;
    std::vector<tinygltf::Accessor> accessors;
    std::vector<tinygltf::BufferView> views;
    std::vector<BufferSource> buffers;
    std::vector<uint32_t> accessor_numbers;             ///< place to number in the file
    std::vector<uint32_t> view_numbers;                 ///< likewise
    std::unordered_map<uint32_t, uint32_t> node_places; ///< number in the file to place
    std::vector<uint32_t> instance_primitives;          ///< the primitive's place, for each instance of the outline
};

/** root: must outlive the result. Throws Failure. */
Filtered filter(const Json &root, const Outline &outline);

/** The vertex attributes that are read, POSITION first, with their numbers per element. */
struct Attribute {
    const char *name;
    size_t components;
};
constexpr Attribute attributes_read[] = {{"POSITION", 3}, {"TANGENT", 4}, {"TEXCOORD_0", 2}};

} // namespace knurl::gltf
#endif

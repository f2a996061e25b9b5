// Knurl: a glTF file cut down to what its tagged surfaces need, every type and range checked. What nothing needs is not
// there at all, so that it costs nothing; what is there has a new place, and messages its old number.
// SPDX-License-Identifier: MIT
#ifndef KNURL_GLTF_FILTER_HPP
#define KNURL_GLTF_FILTER_HPP

#include "outline.hpp"
#include "tinygltf.hpp"

#include <unordered_map>

namespace knurl::gltf {

/** A buffer that something tagged needs. */
struct BufferSource {
    uint32_t number = 0; ///< in the file
    uint32_t byte_length = 0;
    const std::string *uri = nullptr; ///< in the file's JSON; null: the BIN chunk
};

/** Indices are places in these vectors. */
struct Filtered {
    std::vector<tinygltf::Node> nodes;
    std::vector<tinygltf::Primitive> primitives;
    std::vector<tinygltf::Accessor> accessors;
    std::vector<tinygltf::BufferView> views;
    std::vector<BufferSource> buffers;
    std::vector<uint32_t> accessor_numbers;             ///< by their places: their numbers in the file
    std::vector<uint32_t> view_numbers;                 ///< likewise
    std::unordered_map<uint32_t, uint32_t> node_places; ///< by their numbers in the file
    std::vector<uint32_t> instance_primitives;          ///< the place of each of the outline's instances' primitive
};

/** root: must outlive the result. Throws Failure. */
Filtered filter(const Json &root, const Outline &outline);

/** The vertex attributes that are read, POSITION first, and how many numbers an element of each has. */
struct Attribute {
    const char *name;
    size_t components;
};
constexpr Attribute attributes_read[] = {{"POSITION", 3}, {"TANGENT", 4}, {"TEXCOORD_0", 2}};

} // namespace knurl::gltf
#endif

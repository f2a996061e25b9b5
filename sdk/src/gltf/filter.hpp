// Knurl: a glTF file cut down to what its tagged surfaces need, every type and range checked, for tinygltf to read.
// What nothing needs is not there at all, so that it costs nothing; what is there has a new place, and messages its old
// number. SPDX-License-Identifier: MIT
#ifndef KNURL_GLTF_FILTER_HPP
#define KNURL_GLTF_FILTER_HPP

#include "outline.hpp"

#include <unordered_map>

namespace knurl::gltf {

/** A buffer that something tagged needs. */
struct BufferSource {
    uint32_t number = 0; ///< in the file
    uint32_t byte_length = 0;
    const std::string *uri = nullptr; ///< in the file's JSON; null: the BIN chunk
};

struct Filtered {
    std::string json;                             ///< one mesh, of all primitives; buffers of 1 byte
    std::vector<BufferSource> buffers;            ///< by their places in the JSON
    std::vector<uint32_t> accessors;              ///< likewise: their numbers in the file
    std::vector<uint32_t> views;                  ///< likewise, of bufferViews
    std::unordered_map<uint32_t, uint32_t> nodes; ///< by their numbers in the file: their places
    std::vector<uint32_t> primitives;             ///< of each of the outline's instances: its place in the mesh
};

/** root: must outlive the result. Throws Failure. */
Filtered filter(const nlohmann::json &root, const Outline &outline);

/** The vertex attributes that are read, POSITION first, and how many numbers an element of each has. */
struct Attribute {
    const char *name;
    size_t components;
};
constexpr Attribute attributes_read[] = {{"POSITION", 3}, {"TANGENT", 4}, {"TEXCOORD_0", 2}};

} // namespace knurl::gltf
#endif

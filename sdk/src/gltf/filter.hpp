// Knurl: a glTF file cut down to what its tagged surfaces need, every type and range checked, for tinygltf to read.
// SPDX-License-Identifier: MIT
#ifndef KNURL_GLTF_FILTER_HPP
#define KNURL_GLTF_FILTER_HPP

#include "outline.hpp"

namespace knurl::gltf {

/** A buffer of the file; those that nothing tagged needs are never read. */
struct BufferSource {
    bool needed = false;
    uint32_t byte_length = 0;
    const std::string *uri = nullptr; ///< in the file's JSON; null: the BIN chunk
};

struct Filtered {
    std::string json; ///< all indices as in the file; what is not needed is a stub; buffer i has URI "i"
    std::vector<BufferSource> buffers; ///< as many as in the JSON
};

/** root: must outlive the result. Throws Failure. */
Filtered filter(const nlohmann::json &root, const Outline &outline);

/** The vertex attributes that are read. */
constexpr const char *attribute_names[] = {"POSITION", "TANGENT", "TEXCOORD_0"};

} // namespace knurl::gltf
#endif

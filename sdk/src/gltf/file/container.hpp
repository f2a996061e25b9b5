// Knurl: splits a .gltf or .glb file into JSON text and binary chunk.
// SPDX-License-Identifier: MIT
#ifndef KNURL_GLTF_CONTAINER_HPP
#define KNURL_GLTF_CONTAINER_HPP

#include "files.hpp"

namespace knurl::gltf {

/** Both point into the bytes that were split. */
struct Container {
    std::string_view json;
    std::optional<Bytes> bin;
};

/** Detects the format by content: a .glb starts with "glTF". Checks every length in a .glb. Throws Failure. */
Container split(Bytes bytes);

/** The file with other JSON text. Its other chunks and the bytes after its declared length stay. Throws Failure. */
std::string with_json(Bytes file, const Container &container, std::string json);

} // namespace knurl::gltf
#endif

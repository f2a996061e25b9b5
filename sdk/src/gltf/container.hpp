// Knurl: a glTF file's two parts, JSON text and binary chunk, out of a .gltf's or a .glb's bytes.
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

/** The content decides: a .glb starts with the magic "glTF". Every length of a .glb is checked. */
Container split(Bytes bytes);

} // namespace knurl::gltf
#endif

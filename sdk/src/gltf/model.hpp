// Knurl: the tagged part of a glTF file, and the bytes of its buffers.
// SPDX-License-Identifier: MIT
#ifndef KNURL_GLTF_MODEL_HPP
#define KNURL_GLTF_MODEL_HPP

#include "files.hpp"
#include "filter.hpp"

namespace knurl::gltf {

/** Not movable: points into itself and the resources' BIN chunk. */
struct Model {
    Filtered filtered;
    Sources sources;
    std::map<int, Bytes> buffers; ///< by their numbers in the file
};

/** Fills in `model` and reads its buffers. Throws Failure. */
void load_model(Filtered filtered, const Resources &resources, Model &model);

} // namespace knurl::gltf
#endif

// Knurl: the tagged part of a glTF file as tinygltf's model, buffers read.
// SPDX-License-Identifier: MIT
#ifndef KNURL_GLTF_MODEL_HPP
#define KNURL_GLTF_MODEL_HPP

#include "files.hpp"
#include "filter.hpp"
#include "tinygltf.hpp"

namespace knurl::gltf {

/** Throws Failure. */
tinygltf::Model load_model(const Filtered &filtered, const Resources &resources);

} // namespace knurl::gltf
#endif

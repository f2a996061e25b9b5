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
    std::vector<Bytes> buffers;

    /** "accessor 7", the number in the file. */
    std::string accessor_label(int place) const {
        return "accessor " + std::to_string(filtered.accessor_numbers.at(static_cast<size_t>(place)));
    }
};

/** Fills in `model` and reads its buffers. Throws Failure. */
void load_model(Filtered filtered, const Resources &resources, Model &model);

} // namespace knurl::gltf
#endif
